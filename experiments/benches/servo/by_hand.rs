//! What one writes by hand.

use profiles::Sample;

use crate::{
    ACCELERATION_GAIN, BANDWIDTH, CURRENT_LIMIT, FLUX, FRICTION, INDUCTANCE, LOAD, PERIOD, POLE_PAIRS,
    POSITION_GAIN, RESISTANCE, ROTOR, SPRING_DAMPING, STIFFNESS, TORQUE_CONSTANT, VELOCITY_GAIN,
    VELOCITY_INTEGRAL, VOLTAGE_LIMIT,
};

/// The same by hand: plain numbers, nothing checked, clamped integrals.
#[derive(Clone, Default)]
pub(crate) struct ByHand {
    r: f64,
    l: f64,
    per_l: f64,
    flux: f64,
    pairs: f64,
    torque_constant: f64,
    stiffness: f64,
    friction: f64,
    spring_damping: f64,
    per_rotor: f64,
    per_load: f64,
    position_gain: f64,
    velocity_gain: f64,
    velocity_step: f64,
    acceleration_gain: f64,
    current_gain: f64,
    current_reset: f64,
    current_limit: f64,
    voltage_limit: f64,
    velocity_integral: f64,
    d_integral: f64,
    q_integral: f64,
    // Voltage less decoupling of the tick before.
    d_drop: f64,
    q_drop: f64,
    pub(crate) state: [f64; 6],
}

impl ByHand {
    pub(crate) fn new() -> Self {
        Self {
            r: RESISTANCE,
            l: INDUCTANCE,
            per_l: 1.0 / INDUCTANCE,
            flux: FLUX,
            pairs: f64::from(POLE_PAIRS),
            torque_constant: TORQUE_CONSTANT,
            stiffness: STIFFNESS,
            friction: FRICTION,
            spring_damping: SPRING_DAMPING,
            per_rotor: 1.0 / ROTOR,
            per_load: 1.0 / LOAD,
            position_gain: POSITION_GAIN,
            velocity_gain: VELOCITY_GAIN,
            velocity_step: VELOCITY_INTEGRAL * PERIOD,
            acceleration_gain: ACCELERATION_GAIN,
            current_gain: INDUCTANCE * BANDWIDTH,
            current_reset: 1.0 - (-PERIOD * RESISTANCE / INDUCTANCE).exp(),
            current_limit: CURRENT_LIMIT,
            voltage_limit: VOLTAGE_LIMIT,
            ..Self::default()
        }
    }

    #[inline(always)]
    fn voltage(&mut self, reference: &Sample) -> [f64; 2] {
        let [i_d, i_q, angle, speed, ..] = self.state;
        let wanted = self.position_gain * (reference.position - angle) + reference.velocity;
        let error = wanted - speed;
        let limit = self.current_limit;
        self.velocity_integral = (self.velocity_integral + self.velocity_step * error).clamp(-limit, limit);
        let current = self.velocity_gain * error
            + self.velocity_integral
            + self.acceleration_gain * reference.acceleration;
        let current = current.clamp(-limit, limit);

        let w = self.pairs * speed;
        let (d_coupling, q_coupling) = (-w * self.l * i_q, w * (self.l * i_d + self.flux));
        self.d_integral += self.current_reset * (self.d_drop - self.d_integral);
        self.q_integral += self.current_reset * (self.q_drop - self.q_integral);
        let mut d = d_coupling + self.d_integral - self.current_gain * i_d;
        let mut q = q_coupling + self.q_integral + self.current_gain * (current - i_q);
        let square = d * d + q * q;
        if square > self.voltage_limit * self.voltage_limit {
            let scale = self.voltage_limit / square.sqrt();
            (d, q) = (scale * d, scale * q);
        }
        (self.d_drop, self.q_drop) = (d - d_coupling, q - q_coupling);
        [d, q]
    }

    #[inline(always)]
    pub(crate) fn derivative(
        &self,
        [i_d, i_q, angle, speed, load_angle, load_speed]: [f64; 6],
        [d, q]: [f64; 2],
    ) -> [f64; 6] {
        let w = self.pairs * speed;
        let spring = self.stiffness * (angle - load_angle) + self.spring_damping * (speed - load_speed);
        [
            (d - self.r * i_d + w * self.l * i_q) * self.per_l,
            (q - self.r * i_q - w * (self.l * i_d + self.flux)) * self.per_l,
            speed,
            (self.torque_constant * i_q - spring - self.friction * speed) * self.per_rotor,
            load_speed,
            spring * self.per_load,
        ]
    }

    #[inline(always)]
    pub(crate) fn tick(&mut self, reference: &Sample) {
        const H: f64 = PERIOD;
        let v = self.voltage(reference);
        let x = self.state;
        let along = |k: [f64; 6], h: f64| std::array::from_fn(|i| x[i] + h * k[i]);
        let k1 = self.derivative(x, v);
        let k2 = self.derivative(along(k1, 0.5 * H), v);
        let k3 = self.derivative(along(k2, 0.5 * H), v);
        let k4 = self.derivative(along(k3, H), v);
        self.state = std::array::from_fn(|i| x[i] + H / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
    }
}
