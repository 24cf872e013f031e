"""What the obstacle sensor and the rangefinder can see: the solids of the mission's world.

Frame: truth's n, local NED from home. The ground is not among them.
"""

from dataclasses import dataclass, field

import numpy as np

from fakevehicle.vocabulary import FloatArray


@dataclass(frozen=True, slots=True)
class World:
    """Solids in truth's n [m].

    Attributes
    ----------
    boxes : (n, 6) low and high corner.
    spheres : (n, 4) centre and radius.
    cylinders : (n, 5) centre of the axis north and east, radius, upper and lower end (down coordinates).
    """

    boxes: FloatArray = field(default_factory=lambda: np.zeros((0, 6)))
    spheres: FloatArray = field(default_factory=lambda: np.zeros((0, 4)))
    cylinders: FloatArray = field(default_factory=lambda: np.zeros((0, 5)))
