//! One move planned with every law: how long it takes, what it asks of the drive, what it leaves vibrating.

use profiles::{
    Cosine, FivePhase, Limits, Mode, Profile, SCurve, SnapLimited, Trapezoid, residual_vibration,
    write_c_table,
};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let distance = 0.04;
    let limits = Limits::new(0.2, 4.0, 200.0)?.with_snap(12_500.0)?;
    let mode = Mode::from_hz(33.0, 0.02)?;

    let trapezoid = Trapezoid::rest_to_rest(distance, &limits)?;
    let s_curve = SCurve::rest_to_rest(distance, &limits)?;
    let snap_limited = SnapLimited::rest_to_rest(distance, &limits)?;
    let cosine = Cosine::rest_to_rest(distance, &limits)?;
    let five_phase = FivePhase::rest_to_rest(distance, &limits)?;
    let laws: [(&str, &dyn Profile); 5] = [
        ("trapezoid", &trapezoid),
        ("s-curve", &s_curve),
        ("snap-limited", &snap_limited),
        ("cosine", &cosine),
        ("five-phase", &five_phase),
    ];

    println!(
        "{:<14}{:>10}{:>16}{:>16}{:>18}",
        "law", "T [ms]", "a max [m/s^2]", "j max [m/s^3]", "vibration [um]"
    );
    for (name, profile) in laws {
        let extrema = profile.extrema();
        println!(
            "{name:<14}{:>10.2}{:>16.3}{:>16.1}{:>18.3}",
            1e3 * profile.duration(),
            extrema.acceleration.upper,
            extrema.jerk.upper,
            1e6 * residual_vibration(profile, mode),
        );
    }

    let mut table = String::new();
    write_c_table(&s_curve, 0.03, "move", &mut table)?;
    println!("\n{table}");
    Ok(())
}
