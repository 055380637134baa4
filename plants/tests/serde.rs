//! Configurations survive being written, and are checked when read.
#![cfg(feature = "serde")]

use plants::{
    BallScrewAxis, BeltDrive, Clock, Encoder, Friction, LinearMotor, LowPass, Pmsm, PmsmDrive, PmsmWindings,
    TransferFunction, TwoInertia,
};

#[test]
fn round_trips() {
    let clock = Clock::from_period(3, 8).expect("valid");
    let text = serde_json::to_string(&clock).expect("writes");
    assert_eq!(serde_json::from_str::<Clock>(&text).expect("reads"), clock);
    for motor in [
        LinearMotor::new(2.0, 0.1).expect("valid"),
        LinearMotor::new(2.0, 0.0)
            .and_then(|m| m.driven_by_current(3.0)?.with_force_limit(4.0))
            .expect("valid"),
    ] {
        let text = serde_json::to_string(&motor).expect("writes");
        assert_eq!(serde_json::from_str::<LinearMotor>(&text).expect("reads"), motor);
    }
}

#[test]
fn drives_round_trip() {
    let windings = PmsmWindings::new(2.875, 8.5e-3, 11e-3, 0.175, 3).expect("valid");
    for windings in [windings, windings.with_voltage_limit(300.0).expect("valid")] {
        let motor = Pmsm::new(windings, 0.003).and_then(|m| m.with_friction(0.008)).expect("valid");
        let text = serde_json::to_string(&motor).expect("writes");
        assert_eq!(serde_json::from_str::<Pmsm>(&text).expect("reads"), motor);
        let drive = motor.coupled_with_damping(5e-4, 100.0, 0.006, 0.001).expect("valid");
        let text = serde_json::to_string(&drive).expect("writes");
        assert_eq!(serde_json::from_str::<PmsmDrive>(&text).expect("reads"), drive);
    }
    let filter = LowPass::new(0.0044).expect("valid");
    let text = serde_json::to_string(&filter).expect("writes");
    assert_eq!(serde_json::from_str::<LowPass>(&text).expect("reads"), filter);
}

#[test]
fn belts_and_transfer_functions_round_trip() {
    let belt = BeltDrive::new(0.004, 0.03, 2.0).and_then(|b| b.with_damping(0.0, 0.01, 0.0)).expect("valid");
    let text = serde_json::to_string(&belt).expect("writes");
    assert_eq!(serde_json::from_str::<BeltDrive>(&text).expect("reads"), belt);
    let transfer = belt.motor_from_torque().expect("finite");
    let text = serde_json::to_string(&transfer).expect("writes");
    assert_eq!(serde_json::from_str::<TransferFunction>(&text).expect("reads"), transfer);
}

#[test]
fn ball_screws_and_friction_round_trip() {
    let axis = BallScrewAxis::new(0.3, 2.0, 7.0).expect("valid");
    let text = serde_json::to_string(&axis).expect("writes");
    assert_eq!(serde_json::from_str::<BallScrewAxis>(&text).expect("reads"), axis);
    let friction = Friction::coulomb(0.3)
        .and_then(|f| f.with_viscous(0.1)?.with_stribeck(0.5, 0.01, 1.5))
        .expect("valid");
    for friction in [friction, Friction::none()] {
        let text = serde_json::to_string(&friction).expect("writes");
        assert_eq!(serde_json::from_str::<Friction>(&text).expect("reads"), friction);
    }
    let weak = r#"{"viscous":0.0,"coulomb":2.0,"breakaway":1.0,"stribeck_speed":1.0,"exponent":2.0}"#;
    assert!(serde_json::from_str::<Friction>(weak).is_err());
    assert!(serde_json::from_str::<BallScrewAxis>(r#"{"a":-1.0,"b":1.0,"k":1.0,"inertia":1.0}"#).is_err());
}

#[test]
fn bad_numbers_are_refused() {
    let lone = r#"{"zeros":[],"poles":[[-1.0,2.0]],"gain":1.0}"#;
    assert!(serde_json::from_str::<TransferFunction>(lone).is_err());
    assert!(serde_json::from_str::<LowPass>(r#"{"time_constant":0.0}"#).is_err());
    let axis = r#"{"motor_inertia":1.0,"load_inertia":1.0,"stiffness":1.0,
        "motor_damping":0.0,"spring_damping":-1.0,"load_damping":0.0}"#;
    assert!(serde_json::from_str::<TwoInertia>(axis).is_err());
    let windings = r#"{"resistance":1.0,"inductance_d":0.0,"inductance_q":1.0,"flux_linkage":1.0,
        "pole_pairs":1,"voltage_limit":null}"#;
    assert!(serde_json::from_str::<PmsmWindings>(windings).is_err());
    assert!(serde_json::from_str::<Clock>(r#"{"numerator":1,"denominator":0}"#).is_err());
    assert!(serde_json::from_str::<Encoder>(r#"{"resolution":-1.0}"#).is_err());
    let motor = r#"{"mass":0.0,"damping":0.0,"force_constant":null,"force_limit":null}"#;
    assert!(serde_json::from_str::<LinearMotor>(motor).is_err());
}
