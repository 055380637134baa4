//! One move of a vibrating load, quieted in several ways: how long it takes, what it leaves, what frequency error it stands.

use profiles::{Limits, Mode, Profile, PulseTrain, SCurve, residual_vibration};
use shaping::{DelayFilter, DelayLine, DelayLineState, Impulse, ImpulseTrain, Shaped};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mode = Mode::from_hz(33.0, 0.02)?;
    let beside = Mode::from_hz(33.0 * 1.1, 0.02)?;
    let profile = SCurve::rest_to_rest(0.04, &Limits::new(0.2, 4.0, 200.0)?)?;
    let period = mode.damped_period();

    let nothing = ImpulseTrain::<3>::new(&[Impulse::new(0.0, 1.0)])?;
    let trains = [
        ("as planned", nothing),
        ("0.2 periods", *DelayFilter::new(mode, 0.2 * period)?.train()),
        ("0.3 periods", *DelayFilter::positive(mode, 0.3 * period)?.train()),
        ("0.5 periods (ZVD)", *DelayFilter::zvd(mode)?.train()),
    ];
    println!(
        "{:<20}{:>9}{:>16}{:>20}{:>22}",
        "delay", "T [ms]", "vibration [um]", "10 % off it [um]", "5 % left within [%]"
    );
    for (name, train) in trains {
        let shaped = Shaped::new(profile, train);
        let band = train.insensitivity(mode, 0.05).map_or_else(
            || "-".into(),
            |band| format!("{:+.1} .. {:+.1}", 1e2 * band.lower, 1e2 * band.upper),
        );
        println!(
            "{name:<20}{:>9.1}{:>16.3}{:>20.3}{band:>22}",
            1e3 * shaped.duration(),
            1e6 * residual_vibration(&shaped, mode),
            1e6 * residual_vibration(&shaped, beside),
        );
    }

    // The same filter for a drive with step and direction inputs, 10 um a pulse and at most 50 kHz.
    let filter = DelayFilter::zvd(mode)?;
    let shaped = Shaped::new(profile, *filter.train());
    let train = PulseTrain::new(&shaped, 1e-5)?.with_shortest_interval(1.0 / 50e3)?;
    println!(
        "\n{} pulses, at most {:.0} a second; the first of them:",
        train.total(),
        train.peak_frequency()
    );
    for pulse in train.pulses().take(3) {
        println!("{:>12.3} ms {:>+3}", 1e3 * pulse.instant, pulse.direction.sign());
    }

    // And for a set-point that jumps, at 1 kHz: the taps of the delay line and its answer to a step of 1.
    let line = DelayLine::<f32, 6, 64>::new(filter.train(), mode, 1e-3)?;
    let mut state = DelayLineState::at_rest(0.0);
    let steps = (0..=32).map(|_| line.update(&mut state, 1.0).output).step_by(8);
    println!("\ndelay line, every 8 ms: {:?}", steps.collect::<Vec<f32>>());
    Ok(())
}
