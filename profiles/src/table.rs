//! A planned motion as text: CSV for a spreadsheet, C for a controller.

use core::fmt::Write;

use crate::cursor::{check_clock, instant_rounding};
use crate::error::TableError;
use crate::profile::Profile;
use crate::quantities::{Real, Sample};

/// The most rows a table may have.
const MOST_ROWS: f64 = 100_000_000.0;

/// The columns after the time, with the power of the second in their unit.
const COLUMNS: [(&str, u32); 5] =
    [("position", 0), ("velocity", 1), ("acceleration", 2), ("jerk", 3), ("snap", 4)];

/// Writes a profile as comma-separated values: a header with units, then a row every `period` seconds from the
/// start to the first tick at or after the end. `unit` is that of the position, `"m"` or `"rad"`.
///
/// Every number is printed with the fewest digits that read back as the same number.
///
/// # Errors
/// A period that is not positive and finite, more than 100 000 000 rows, a unit with a comma, quote or line break,
/// or whatever the writer reports.
pub fn write_csv<P, W>(profile: &P, period: f64, unit: &str, out: &mut W) -> Result<(), TableError>
where
    P: Profile + ?Sized,
    W: Write + ?Sized,
{
    let rows = row_count(profile, period)?;
    if unit.contains([',', '"', '\n', '\r']) {
        return Err(TableError::Unit);
    }
    write!(out, "time [s]")?;
    for (name, power) in COLUMNS {
        match power {
            0 => write!(out, ",{name} [{unit}]")?,
            1 => write!(out, ",{name} [{unit}/s]")?,
            _ => write!(out, ",{name} [{unit}/s^{power}]")?,
        }
    }
    writeln!(out)?;
    for row in 0..rows {
        let time = f64::from(row) * period;
        let Sample { position, velocity, acceleration, jerk, snap } =
            sample_of_row(profile, row, rows, period);
        writeln!(out, "{time},{position},{velocity},{acceleration},{jerk},{snap}")?;
    }
    Ok(())
}

/// Writes a profile as C: `NAME_LENGTH`, `NAME_PERIOD` in s and one `static const` array of `float` for position,
/// velocity and acceleration each, a row every `period` seconds from the start to the first tick at or after the
/// end.
///
/// `name` is the prefix, a C identifier.
///
/// # Errors
/// A period that is not positive and finite, more than 100 000 000 rows, a name that is not a C identifier, a value
/// beyond single precision, or whatever the writer reports.
pub fn write_c_table<P, W>(profile: &P, period: f64, name: &str, out: &mut W) -> Result<(), TableError>
where
    P: Profile + ?Sized,
    W: Write + ?Sized,
{
    let rows = row_count(profile, period)?;
    let mut letters = name.bytes();
    let starts = letters.next().is_some_and(|c| c.is_ascii_alphabetic() || c == b'_');
    if !(starts && letters.all(|c| c.is_ascii_alphanumeric() || c == b'_')) {
        return Err(TableError::Name);
    }
    let largest = profile.extrema();
    for (quantity, bounds) in [
        ("position", largest.position),
        ("velocity", largest.velocity),
        ("acceleration", largest.acceleration),
    ] {
        if bounds.magnitude() > f64::from(f32::MAX) {
            return Err(TableError::BeyondSingle { quantity, value: bounds.magnitude() });
        }
    }
    writeln!(
        out,
        "/* Motion profile: {rows} rows, one every {period} s, {} s in all. SI units. */",
        profile.duration()
    )?;
    for (what, value) in [("LENGTH", None), ("PERIOD", Some(period as f32))] {
        write!(out, "#define ")?;
        for letter in name.chars() {
            out.write_char(letter.to_ascii_uppercase())?;
        }
        match value {
            None => writeln!(out, "_{what} {rows}")?,
            Some(value) => writeln!(out, "_{what} {value:e}f")?,
        }
    }
    for (order, (column, unit)) in
        [("position", "m"), ("velocity", "m/s"), ("acceleration", "m/s^2")].into_iter().enumerate()
    {
        writeln!(out, "\n/* {column}, {unit} */\nstatic const float {name}_{column}[{rows}] = {{")?;
        for row in 0..rows {
            let Sample { position, velocity, acceleration, .. } = sample_of_row(profile, row, rows, period);
            let value = match order {
                0 => position,
                1 => velocity,
                _ => acceleration,
            };
            let separator = if row + 1 == rows {
                "\n};\n"
            } else if row % 4 == 3 {
                ",\n"
            } else {
                ", "
            };
            write!(out, "{:e}f{separator}", value as f32)?;
        }
    }
    Ok(())
}

/// Rows from the start to the first tick at or after the end.
fn row_count<P: Profile + ?Sized>(profile: &P, period: f64) -> Result<u32, TableError> {
    check_clock(profile.duration(), period)?;
    let duration = profile.duration();
    let ticks = Real::ceil((duration - instant_rounding(duration)) / period);
    if ticks >= MOST_ROWS {
        return Err(TableError::TooManyRows { rows: ticks, most: MOST_ROWS });
    }
    Ok(ticks as u32 + 1)
}

/// The sample of a row; the last row shows the end.
fn sample_of_row<P: Profile + ?Sized>(profile: &P, row: u32, rows: u32, period: f64) -> Sample {
    let t = f64::from(row) * period;
    profile.sample(if row + 1 == rows { t.max(profile.duration()) } else { t })
}

#[cfg(test)]
mod tests {
    use std::string::String;

    use super::*;
    use crate::{Limits, SCurve, Trapezoid};

    fn profile() -> SCurve {
        SCurve::rest_to_rest(0.04, &Limits::new(0.2, 4.0, 200.0).expect("limits")).expect("plan")
    }

    #[test]
    fn csv_reads_back_bit_for_bit() {
        let (profile, mut text) = (profile(), String::new());
        write_csv(&profile, 1e-3, "m", &mut text).expect("written");
        let mut lines = text.lines();
        assert_eq!(
            lines.next(),
            Some("time [s],position [m],velocity [m/s],acceleration [m/s^2],jerk [m/s^3],snap [m/s^4]")
        );
        let mut rows = 0;
        for line in lines {
            let numbers: std::vec::Vec<f64> = line.split(',').map(|n| n.parse().expect("number")).collect();
            let sample = profile.sample(numbers[0]);
            assert_eq!(
                numbers[1..],
                [sample.position, sample.velocity, sample.acceleration, sample.jerk, sample.snap]
            );
            rows += 1;
        }
        // 0.27 s: rows at 0 ... 270 ms.
        assert_eq!(rows, 271);
        assert!(text.trim_end().ends_with(",0.04,0,0,0,0"));
    }

    #[test]
    fn the_last_row_shows_the_end() {
        let profile = Trapezoid::rest_to_rest(1.0, &Limits::new(0.3, 0.7, f64::INFINITY).expect("limits"));
        let profile = profile.expect("plan");
        for divisions in 1..200_u32 {
            let period = profile.duration() / f64::from(divisions);
            let rows = row_count(&profile, period).expect("rows");
            assert_eq!(rows, divisions + 1);
            assert_eq!(sample_of_row(&profile, rows - 1, rows, period), Sample::at_rest(1.0));
        }
    }

    #[test]
    fn c_table_has_the_counts_it_declares() {
        let mut text = String::new();
        write_c_table(&profile(), 0.01, "lift_axis", &mut text).expect("written");
        assert!(text.contains("#define LIFT_AXIS_LENGTH 28\n"), "{text}");
        assert!(text.contains("static const float lift_axis_position[28] = {"));
        let body = text.split("lift_axis_velocity[28] = {").nth(1).expect("array");
        let body = body.split('}').next().expect("end");
        assert_eq!(body.matches('f').count(), 28);
        assert!(body.contains("2e-1f"));
    }

    #[test]
    fn bad_requests_write_nothing() {
        let mut text = String::new();
        assert!(matches!(write_c_table(&profile(), 0.01, "2fast", &mut text), Err(TableError::Name)));
        assert!(matches!(write_c_table(&profile(), 0.01, "", &mut text), Err(TableError::Name)));
        assert!(matches!(write_csv(&profile(), 0.0, "m", &mut text), Err(TableError::Clock(_))));
        assert!(matches!(write_csv(&profile(), 1e-12, "m", &mut text), Err(TableError::TooManyRows { .. })));
        assert!(matches!(write_csv(&profile(), 0.1, "m,s", &mut text), Err(TableError::Unit)));
        assert!(text.is_empty());
    }
}
