"""The planner's refusals in the words of the mission file: north, east, altitude, and by how much."""

from planner import (
    GoalInCollision,
    GoalOutOfBounds,
    PlannerError,
    StartInCollision,
    StartOutOfBounds,
    ViaInCollision,
    ViaOutOfBounds,
)


def in_mission_words(error: PlannerError) -> str:
    """One clause for a person; the planner speaks of x, y and z, which are north, east and down here."""
    match error:
        case StartInCollision() | GoalInCollision() | ViaInCollision():
            thing = f"obstacle {error.obstacle} ({error.kind})"
            where = f"{error.distance:.2f} m from" if error.distance >= 0 else f"{-error.distance:.2f} m inside"
        case StartOutOfBounds() | GoalOutOfBounds() | ViaOutOfBounds():
            down = error.axis == 2
            side = {"lower": "upper", "upper": "lower"}[error.side] if down else error.side
            bound = -error.bound + 0.0 if down else error.bound  # + 0.0: no minus sign before a zero
            thing = f"the {side} {('north', 'east', 'altitude')[error.axis]} bound {bound:g}"
            where = f"{error.distance:.2f} m inside" if error.distance >= 0 else f"{-error.distance:.2f} m beyond"
        case _:
            return str(error)
    north, east, z = error.point
    place = f"the {error.which} at north {north:g}, east {east:g}, altitude {-z:g}"
    return f"{place} is {where} {thing}; {error.shortfall:.2f} m more are needed to keep {error.radius:g} m"
