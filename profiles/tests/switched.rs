//! Motions between switches: derivatives of their conditions, corrections to rounding, and profiles that end exactly.
#![expect(clippy::expect_used, clippy::float_cmp, reason = "helpers fail as tests do; ends are exact")]

mod common;

use common::{magnitude, orders, rounding, sections};
use profiles::switched::{Arc, Condition, Contact, Goal, Switched, Zero};
use profiles::{Complex, Limits, Mode, Profile, SCurve, residual_vibration};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

/// Room for more arcs than there are.
const N: usize = 14;

type Motion = Switched<N>;

/// A motion with arcs of about one second, and what is asked of it.
#[derive(Debug, Clone)]
struct Asked {
    motion: Motion,
    goal: Goal,
    zeros: Vec<Zero>,
    contacts: Vec<Contact>,
}

fn arcs() -> impl Strategy<Value = Vec<Arc>> {
    let jerk =
        prop_oneof![3 => magnitude(0.3, 3.0), 3 => magnitude(0.3, 3.0).prop_map(|j| -j), 1 => Just(0.0)];
    let arc = (jerk, magnitude(0.1, 2.0)).prop_map(|(jerk, duration)| Arc { jerk, duration });
    prop::collection::vec(arc, 2..=11)
}

fn a_zero() -> impl Strategy<Value = Zero> {
    let rest = || prop_oneof![1 => Just(0.0), 1 => -1.0..1.0_f64];
    (magnitude(0.05, 20.0), prop_oneof![Just(0.0), 0.0..0.9], any::<bool>(), rest(), rest()).prop_map(
        |(w, z, double, re, im)| {
            Zero::new(Mode::new(w, z).expect("mode"), double).with_rest(Complex::new(re, im))
        },
    )
}

/// What nothing of the motion must meet.
fn asked() -> impl Strategy<Value = Asked> {
    let contact = (0..3, any::<prop::sample::Index>(), -2.0..2.0_f64);
    let goal = (-2.0..2.0_f64, prop::option::of(-2.0..2.0_f64));
    let zeros = prop::collection::vec(a_zero(), 0..=2);
    (-2.0..2.0_f64, arcs(), goal, zeros, prop::collection::vec(contact, 0..=4)).prop_map(
        |(from, arcs, (velocity, distance), zeros, contacts)| {
            let contact = |(kind, index, value): &(i32, prop::sample::Index, f64)| {
                let (arc, value) = (index.index(arcs.len()), *value);
                match kind {
                    0 => Contact::Acceleration { arc, value },
                    1 => Contact::Velocity { arc, value },
                    // Without jerk the velocity does not turn.
                    _ if arcs[arc].jerk == 0.0 => Contact::Velocity { arc, value },
                    _ => Contact::Turn { arc, value },
                }
            };
            let contacts = contacts.iter().map(contact).collect();
            let motion = Motion::new(from, &arcs).expect("room");
            Asked { motion, goal: Goal { velocity, distance }, zeros, contacts }
        },
    )
}

impl Asked {
    fn conditions(&self, motion: &Motion) -> Vec<Condition<N>> {
        let mut all = vec![];
        motion.conditions(&self.goal, &self.zeros, &self.contacts, |condition| all.push(*condition));
        all
    }

    /// With the arc `k` longer by `h`.
    fn with(&self, k: usize, h: f64) -> Vec<Condition<N>> {
        let mut arcs = self.motion.arcs().to_vec();
        arcs[k].duration += h;
        self.conditions(&Motion::new(self.motion.start_velocity(), &arcs).expect("room"))
    }

    /// Derivatives of numbers of every condition by the duration of arc `k`, to the fourth order of the step.
    fn slope<const M: usize>(&self, k: usize, of: impl Fn(&Condition<N>) -> [f64; M]) -> Vec<[f64; M]> {
        let h = 2e-3;
        let [far_back, back, on, far_on] = [-2.0 * h, -h, h, 2.0 * h].map(|h| self.with(k, h));
        let at = |i: usize| {
            let [a, b, c, d] = [&far_back[i], &back[i], &on[i], &far_on[i]].map(&of);
            std::array::from_fn(|m| (8.0 * (c[m] - b[m]) - (d[m] - a[m])) / (12.0 * h))
        };
        (0..on.len()).map(at).collect()
    }
}

/// Fourth derivatives of `e^(20 t)` times 2e-3^4 / 30, and roundings over 2e-3, of numbers of this size.
fn close(a: f64, b: f64, size: f64) -> bool {
    (a - b).abs() <= 1e-7 * (1.0 + size)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn derivatives_are_those_of_finite_differences(asked in asked()) {
        let conditions = asked.conditions(&asked.motion);
        let zeros: usize = asked.zeros.iter().map(Zero::conditions).sum();
        let ends = 2 + usize::from(asked.goal.distance.is_some());
        prop_assert_eq!(conditions.len(), ends + zeros + asked.contacts.len());
        let arcs = asked.motion.arcs();
        let sizes: Vec<f64> = conditions
            .iter()
            .map(|c| c.gradient.iter().chain(&c.curvature).fold(c.value.abs(), |size, x| size.max(x.abs())))
            .collect();
        for l in 0..arcs.len() {
            let values = asked.slope(l, |condition| [condition.value]);
            let gradients = asked.slope(l, |condition| condition.gradient);
            for (i, condition) in conditions.iter().enumerate() {
                let size = sizes[i] + condition.bend.abs() * 9.0;
                let [slope] = values[i];
                prop_assert!(close(slope, condition.gradient[l], size),
                    "gradient {i} by {l}: {slope} {}", condition.gradient[l]);
                for k in 0..arcs.len() {
                    let known = if k.max(l) < condition.arcs {
                        condition.curvature[k.min(l)] - condition.bend * arcs[k].jerk * arcs[l].jerk
                    } else {
                        0.0
                    };
                    let slope = gradients[i][k];
                    prop_assert!(close(slope, known, 20.0 * size), "curvature {i} by {k} and {l}: {slope} {known}");
                }
            }
        }
        for condition in &conditions {
            prop_assert!(condition.gradient.iter().skip(condition.arcs).all(|slope| *slope == 0.0));
        }
    }

    #[test]
    fn responses_are_those_of_quadrature(
        arcs in arcs(),
        w in magnitude(1e-6, 100.0),
        z in prop_oneof![Just(0.0), 0.0..0.99],
        start in prop::array::uniform4(-1.0..1.0_f64),
    ) {
        let zero = Zero::new(Mode::new(w, z).expect("mode"), true);
        let (p, size) = (zero.pole(), zero.pole().norm());
        let begin = [Complex::new(start[0], start[1]), Complex::new(start[2], start[3])];
        let [q, r] = arcs.iter().fold(begin, |response, arc| zero.after(response, arc));
        let duration: f64 = arcs.iter().map(|arc| arc.duration).sum();
        let turn = (p * duration).exp();
        let (mut known, mut slope) = (turn * begin[0], turn * (begin[1] + begin[0] * (size * duration)));
        let mut before = 0.0;
        for arc in &arcs {
            // Simpson's rule on panels of at most a fiftieth of a radian: off by 1e-9 / 2880 of each.
            let panels = (50.0 * size * arc.duration).ceil().max(8.0);
            let step = arc.duration / panels;
            for panel in 0..panels as usize {
                for (part, weight) in [(0.0, 1.0), (0.5, 4.0), (1.0, 1.0)] {
                    let left = duration - before - (panel as f64 + part) * step;
                    let term = (p * left).exp() * (arc.jerk * weight * step / 6.0);
                    known += term;
                    slope += term * (left * size);
                }
            }
            before += arc.duration;
        }
        let scale = 1.0 + 3.0 * duration;
        prop_assert!((q - known).norm() <= 1e-10 * scale, "{q} {known}");
        prop_assert!((r - slope).norm() <= 1e-10 * scale * (1.0 + size * duration), "{r} {slope}");
        // One that is not double gives the same, and no slope.
        let plain = Zero::new(Mode::new(w, z).expect("mode"), false);
        let [single, nothing] = arcs.iter().fold(begin, |response, arc| plain.after(response, arc));
        prop_assert_eq!((single, nothing), (q, Complex::default()));
    }

    #[test]
    fn a_profile_goes_through_its_switches_and_ends_exactly(asked in asked(), velocity in -2.0..2.0_f64) {
        let Asked { motion, .. } = asked;
        // To a stop of the acceleration, and there is the goal.
        let states: Vec<_> = motion.states().collect();
        let left = states.last().expect("an end").acceleration;
        let mut arcs = motion.arcs().to_vec();
        arcs.push(Arc { jerk: -left.signum(), duration: left.abs() });
        let motion = Motion::new(velocity, &arcs).expect("room");
        let states: Vec<_> = motion.states().collect();
        let end = states.last().expect("an end");
        for distance in [None, Some(end.position)] {
            let goal = Goal { velocity: end.velocity, distance };
            let profile = motion.profile(&goal, &[]);
            let last = profile.sample(profile.duration());
            prop_assert_eq!((last.position, last.velocity, last.acceleration), (end.position, end.velocity, 0.0));
            prop_assert_eq!(profile.sample(-1.0).velocity, velocity);
            prop_assert_eq!(profile.sample(0.0).position, 0.0);
            // A dozen of roundings of a dozen of arcs.
            let tolerance = rounding(&profile).map(|x| 16.0 * x);
            for state in &states[..arcs.len()] {
                let sample = orders(profile.sample(state.time));
                for (k, known) in [state.position, state.velocity, state.acceleration].iter().enumerate() {
                    prop_assert!((sample[k] - known).abs() <= tolerance[k], "{k} at {}: {} {known}", state.time, sample[k]);
                }
            }
            let sections = sections(&profile);
            for pair in sections.windows(2) {
                let before = orders(pair[0].at_local(pair[0].local_ends().1));
                let after = orders(pair[1].at_local(pair[1].local_ends().0));
                for k in 0..3 {
                    prop_assert!((before[k] - after[k]).abs() <= tolerance[k], "{k} {} {}", before[k], after[k]);
                }
            }
            let effort: f64 = sections.iter().map(|s| s.polynomial.jerk.powi(2) * s.length()).sum();
            prop_assert!((effort - motion.effort()).abs() <= 1e-12 * (1.0 + effort));
        }
    }
}

/// A motion that meets what is asked: rests of its own responses, and contacts where it is.
fn met(asked: &Asked) -> Option<Asked> {
    let left = asked.motion.states().last()?.acceleration;
    let mut arcs = asked.motion.arcs().to_vec();
    arcs.push(Arc { jerk: -left.signum(), duration: left.abs() });
    let motion = Motion::new(asked.motion.start_velocity(), &arcs)?;
    let end = motion.states().last()?;
    let rest = |zero: &Zero| {
        let plain = Zero::at(zero.pole(), false);
        let [q, _] = arcs.iter().fold(Default::default(), |response, arc| plain.after(response, arc));
        plain.with_rest(q)
    };
    let states: Vec<_> = motion.states().collect();
    let at = |contact: &Contact| match *contact {
        Contact::Acceleration { arc, .. } => Contact::Acceleration { arc, value: states[arc].acceleration },
        Contact::Velocity { arc, .. } => Contact::Velocity { arc, value: states[arc].velocity },
        Contact::Turn { arc, .. } => {
            let (state, jerk) = (states[arc], arcs[arc].jerk);
            Contact::Turn { arc, value: state.advanced(jerk, -state.acceleration / jerk).velocity }
        }
    };
    let goal = Goal { velocity: end.velocity, distance: asked.goal.distance.map(|_| end.position) };
    let zeros = asked.zeros.iter().map(rest).collect();
    let contacts = asked.contacts.iter().filter(|contact| contact.arc() > 0).map(at).collect();
    Some(Asked { motion, goal, zeros, contacts })
}

#[test]
fn a_motion_that_is_a_little_off_is_corrected_to_rounding() {
    let mut runner = TestRunner::deterministic();
    let strategy = (asked(), prop::array::uniform14(-1e-4..1e-4_f64));
    let (mut solvable, mut corrected) = (0, 0);
    for _ in 0..2000 {
        let (asked, off) = strategy.new_tree(&mut runner).expect("a motion").current();
        let Some(asked) = met(&asked) else { continue };
        let arcs = asked.motion.arcs();
        let conditions = asked.conditions(&asked.motion).len();
        let moved: Vec<Arc> = arcs
            .iter()
            .zip(off)
            .map(|(arc, off)| Arc { duration: arc.duration * (1.0 + off), ..*arc })
            .collect();
        let moved = Motion::new(asked.motion.start_velocity(), &moved).expect("room");
        let found = moved.corrected(&asked.goal, &asked.zeros, &asked.contacts);
        if conditions > arcs.len() {
            assert!(found.is_none(), "{asked:?}");
            continue;
        }
        solvable += 1;
        let Some(found) = found else { continue };
        corrected += 1;
        assert_eq!(found.arcs().len(), arcs.len());
        assert!(found.arcs().iter().all(|arc| arc.duration >= 0.0));
        for condition in asked.conditions(&found) {
            // Roundings of a dozen arcs, of terms that are as large as the derivatives times the duration.
            let slope = condition.gradient.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
            let size = 1.0 + slope * found.duration();
            assert!(condition.value.abs() <= 1e-13 * size, "{:e} of {size}: {asked:?}", condition.value);
        }
    }
    // The others depend on each other: two contacts of one place, of places without a switch between.
    println!("{corrected} of {solvable}");
    assert!(solvable > 500 && 2 * corrected > solvable, "{corrected} of {solvable}");
}

fn s_curve() -> (SCurve, Vec<Arc>, Vec<Contact>) {
    let limits = Limits::new(0.5, 5.0, 200.0).expect("limits");
    let s_curve = SCurve::rest_to_rest(0.1, &limits).expect("plan");
    let arcs =
        sections(&s_curve).iter().map(|s| Arc { jerk: s.polynomial.jerk, duration: s.length() }).collect();
    let contacts = vec![
        Contact::Acceleration { arc: 1, value: 5.0 },
        Contact::Velocity { arc: 3, value: 0.5 },
        Contact::Acceleration { arc: 3, value: 0.0 },
        Contact::Acceleration { arc: 5, value: -5.0 },
    ];
    (s_curve, arcs, contacts)
}

#[test]
fn the_s_curve_is_found_from_its_conditions() {
    let (known, arcs, contacts) = s_curve();
    let goal = Goal { velocity: 0.0, distance: Some(0.1) };
    let off = [1.1, 0.9, 1.2, 0.8, 0.95, 1.05, 0.9];
    let rough: Vec<Arc> =
        arcs.iter().zip(off).map(|(arc, off)| Arc { duration: arc.duration * off, ..*arc }).collect();
    let found = Motion::new(0.0, &rough).and_then(|m| m.corrected(&goal, &[], &contacts)).expect("solved");
    for (arc, known) in found.arcs().iter().zip(&arcs) {
        assert!((arc.duration - known.duration).abs() <= 1e-15, "{arc:?} {known:?}");
    }
    assert_eq!(found.switches(), 8);
    let profile = found.profile(&goal, &contacts);
    let peaks = profile.extrema();
    // On its limits exactly, not but for rounding.
    assert_eq!(profile.sample(0.5 * known.duration()).velocity, 0.5);
    assert_eq!(profile.sample(0.05).acceleration, 5.0);
    assert!(peaks.velocity.upper <= 0.5 * (1.0 + 1e-15) && peaks.acceleration.upper <= 5.0 * (1.0 + 1e-15));
    let mode = Mode::from_hz(13.0, 0.04).expect("mode");
    let (ours, theirs) = (residual_vibration(&profile, mode), residual_vibration(&known, mode));
    assert!((ours - theirs).abs() < 1e-15, "{ours} {theirs}");
}

#[test]
fn what_cannot_be_corrected_is_none() {
    let (_, arcs, contacts) = s_curve();
    let motion = Motion::new(0.0, &arcs).expect("room");
    let goal = Goal { velocity: 0.0, distance: Some(0.1) };
    let solved = |goal: Goal, zeros: &[Zero], contacts: &[Contact]| motion.corrected(&goal, zeros, contacts);
    assert!(solved(goal, &[], &contacts).is_some());
    // Eight conditions on seven arcs, and twice the same one.
    let more: Vec<_> = contacts.iter().copied().chain([Contact::Velocity { arc: 2, value: 0.4 }]).collect();
    assert!(solved(goal, &[], &more).is_none());
    assert!(solved(goal, &[], &[contacts[0], contacts[0]]).is_none());
    // Shorter than the way to full velocity and back: the cruise would have to be negative.
    for distance in [0.05, 0.0, -0.1] {
        assert!(solved(Goal { distance: Some(distance), ..goal }, &[], &contacts).is_none(), "{distance}");
    }
    for bad in [f64::NAN, f64::INFINITY, 1e300] {
        assert!(solved(Goal { distance: Some(bad), ..goal }, &[], &contacts).is_none(), "{bad}");
        assert!(solved(Goal { velocity: bad, ..goal }, &[], &[]).is_none(), "{bad}");
        assert!(solved(goal, &[Zero::at(Complex::new(0.0, bad), true)], &[]).is_none(), "{bad}");
        assert!(solved(goal, &[], &[Contact::Acceleration { arc: 1, value: bad }]).is_none(), "{bad}");
    }
    // No condition at an arc that is not there.
    let beyond = [Contact::Velocity { arc: 99, value: 0.1 }, Contact::Turn { arc: 7, value: 0.1 }];
    let mut count = 0;
    motion.conditions(&goal, &[], &beyond, |_| count += 1);
    assert_eq!(count, 3);
    let nothing = Motion::new(0.0, &[]).expect("nothing");
    assert!(nothing.corrected(&goal, &[], &[]).is_none());
    assert_eq!((nothing.switches(), nothing.effort(), nothing.duration()), (0, 0.0, 0.0));
}

#[test]
fn arcs_that_are_too_many_or_no_numbers_are_none() {
    let arc = Arc { jerk: 1.0, duration: 1.0 };
    assert!(Motion::new(0.0, &[arc; N]).is_some() && Motion::new(0.0, &[arc; N + 1]).is_none());
    for bad in [f64::NAN, f64::INFINITY] {
        assert!(Motion::new(bad, &[arc]).is_none());
        assert!(Motion::new(0.0, &[Arc { jerk: bad, ..arc }]).is_none());
        assert!(Motion::new(0.0, &[Arc { duration: bad, ..arc }]).is_none());
    }
    let still = Arc { jerk: 0.0, duration: 1.0 };
    let none = Arc { jerk: -1.0, duration: 0.0 };
    // Arcs that take no time and jerk that goes on are no switches; a cruise at an end is none either.
    let motion = Motion::new(1.0, &[still, arc, none, arc, still]).expect("room");
    assert_eq!((motion.switches(), motion.effort(), motion.start_velocity()), (2, 2.0, 1.0));
    assert_eq!(Contact::Turn { arc: 3, value: 0.5 }.moved(5), Contact::Turn { arc: 5, value: 0.5 });
    assert_eq!(Contact::Velocity { arc: 3, value: 0.5 }.moved(1).arc(), 1);
}
