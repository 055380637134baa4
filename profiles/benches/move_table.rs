//! A move out of a table, beside planning an S-curve.
#![expect(clippy::expect_used, reason = "a bench may fail loudly")]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use profiles::switched::MoveTable;
use profiles::{Limits, Mode, SCurve};

#[path = "../tests/common/moves.rs"]
#[expect(unreachable_pub, reason = "as it is written for a controller")]
mod moves;

fn move_table(criterion: &mut Criterion) {
    let limits = Limits::new(0.5, 5.0, 200.0).expect("limits");
    let mode = Mode::from_hz(8.0, 0.02).expect("mode");
    let mut group = criterion.benchmark_group("move table, one mode");
    group.bench_function("check the table of 13 moves", |b| {
        b.iter(|| MoveTable::<12>::new(black_box(moves::MOVES), &limits, &[mode], false));
    });
    let table = MoveTable::<12>::new(moves::MOVES, &limits, &[mode], false).expect("table");
    for (name, distance) in [("within a run", 0.105), ("between two structures", 0.1121)] {
        group.bench_function(format!("move {name}"), |b| b.iter(|| table.rest_to_rest(black_box(distance))));
    }
    let roomy = MoveTable::<24>::new(moves::MOVES, &limits, &[mode], false).expect("table");
    group.bench_function("move within a run, room for 24 arcs", |b| {
        b.iter(|| roomy.rest_to_rest(black_box(0.105)));
    });
    group.bench_function("s-curve", |b| b.iter(|| SCurve::rest_to_rest(black_box(0.105), &limits)));
    group.finish();
}

criterion_group!(benches, move_table);
criterion_main!(benches);
