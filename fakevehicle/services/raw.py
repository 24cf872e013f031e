"""What few clients ask for, on request: the IMU in whole numbers, the barometer, the motors' commands.

SCALED_IMU and RAW_IMU hold the same here, in milli-g, milliradians a second and milligauss, as ArduPilot's do. PX4
sends only SCALED_PRESSURE by itself; for the rest a client sets the interval (MAVSDK: `set_rate_scaled_imu` and the
like).
"""

from fakevehicle.codec import Message
from fakevehicle.flight import FlightStack
from fakevehicle.services.service import Builder, Service
from fakevehicle.supervisor import Supervisor
from wire.dialect import mavlink

_MILLI_G = 9.80665e-3
_OUTPUTS = 32
_ATTITUDE_GROUP = 0


class Raw(Service):
    """Builders of the five messages.

    Parameters
    ----------
    stack : has the samples.
    supervisor : knows whether the motors are armed.
    """

    def __init__(self, stack: FlightStack, supervisor: Supervisor) -> None:
        self._stack = stack
        self._supervisor = supervisor

    def builders(self) -> dict[int, Builder]:
        """By message id."""
        return {
            mavlink.MAVLINK_MSG_ID_SCALED_IMU: self.scaled_imu,
            mavlink.MAVLINK_MSG_ID_RAW_IMU: self.raw_imu,
            mavlink.MAVLINK_MSG_ID_SCALED_PRESSURE: self.scaled_pressure,
            mavlink.MAVLINK_MSG_ID_ACTUATOR_CONTROL_TARGET: self.actuator_control_target,
            mavlink.MAVLINK_MSG_ID_ACTUATOR_OUTPUT_STATUS: self.actuator_output_status,
        }

    def scaled_imu(self) -> Message:
        """Nine axes, stamped since boot [ms]."""
        return mavlink.MAVLink_scaled_imu_message(self._stack.imu.now_us // 1000 & 0xFFFFFFFF, *self._nine_axes())

    def raw_imu(self) -> Message:
        """Nine axes, stamped since boot [us]."""
        return mavlink.MAVLink_raw_imu_message(self._stack.imu.now_us, *self._nine_axes())

    def scaled_pressure(self) -> Message:
        """Absolute pressure [hPa] and temperature [0.01 degC]; there is no differential sensor."""
        baro, now_us = self._stack.baro, self._stack.imu.now_us
        return mavlink.MAVLink_scaled_pressure_message(
            now_us // 1000 & 0xFFFFFFFF, baro.pressure / 100.0, 0.0, _int16(baro.temperature * 100.0)
        )

    def actuator_control_target(self) -> Message:
        """Roll, pitch, yaw and thrust as shares of the most that is possible of each; 0 while disarmed.

        It is what the commands to the motors come to (after the mixer, thrust as the square of speed), and PX4 sends it
        no more since it allocates control itself.
        """
        speeds = self._stack.control.motor.tolist() if self._supervisor.armed else [0.0] * 4
        front_right, rear_left, front_left, rear_right = (speed * speed for speed in speeds)
        controls = (
            0.5 * (rear_left + front_left - front_right - rear_right),
            0.5 * (front_right + front_left - rear_left - rear_right),
            0.5 * (front_right + rear_left - front_left - rear_right),  # these two turn anticlockwise from above
            0.25 * (front_right + rear_left + front_left + rear_right),
        )
        return mavlink.MAVLink_actuator_control_target_message(
            self._stack.imu.now_us, _ATTITUDE_GROUP, [*controls, 0.0, 0.0, 0.0, 0.0]
        )

    def actuator_output_status(self) -> Message:
        """The motors' commands, 0 to 1 of the maximum; 0 while disarmed."""
        motors = self._stack.control.motor.tolist() if self._supervisor.armed else [0.0] * 4
        return mavlink.MAVLink_actuator_output_status_message(
            self._stack.imu.now_us, len(motors), motors + [0.0] * (_OUTPUTS - len(motors))
        )

    def _nine_axes(self) -> list[int]:
        """Specific force [mg], rates [mrad/s], field [mgauss], each clipped to what fits."""
        imu, mag = self._stack.imu, self._stack.mag
        force = [_int16(value / _MILLI_G) for value in imu.specific_force_b.tolist()]
        rates = [_int16(value * 1e3) for value in imu.omega_b.tolist()]
        return force + rates + [_int16(value * 1e3) for value in mag.field_b.tolist()]


def _int16(value: float) -> int:
    return min(max(round(value), -0x8000), 0x7FFF)
