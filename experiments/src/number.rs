//! Numbers and units as text, the same in the terminal, the report and the README.

/// Digits in which our numbers are printed.
pub const DIGITS: i32 = 4;

/// `x` with [`DIGITS`] significant digits, trailing zeros dropped; every digit of an integer part below a million is kept.
#[must_use]
pub fn short(x: f64) -> String {
    if let Some(decimals) = decimals(x, DIGITS) {
        trim(format!("{x:.decimals$}"))
    } else if x.is_finite() {
        let text = format!("{x:.*e}", (DIGITS - 1).unsigned_abs() as usize);
        match text.split_once('e') {
            Some((mantissa, exponent)) => format!("{}e{exponent}", trim(mantissa.to_owned())),
            None => text,
        }
    } else {
        x.to_string()
    }
}

/// `x` with as many digits as it takes to read the same number back.
#[must_use]
pub fn shortest(x: f64) -> String {
    if x == 0.0 || (1e-4..1e6).contains(&x.abs()) { x.to_string() } else { format!("{x:e}") }
}

/// Half a unit of the last digit that [`short`] prints: the most by which the printed number is off.
#[must_use]
pub fn half_digit(x: f64) -> f64 {
    match decimals(x, DIGITS) {
        Some(decimals) => 0.5 * 10f64.powi(-i32::try_from(decimals).unwrap_or(0)),
        None => 0.5 * 10f64.powi(exponent(x) - (DIGITS - 1)),
    }
}

/// A signed difference in `digits` significant digits, for the error column.
#[must_use]
pub fn signed(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let text = match decimals(x, 2) {
        Some(decimals) => trim(format!("{x:+.decimals$}")),
        None => format!("{x:+.0e}"),
    };
    text.replace("e+", "e")
}

/// A unit written in ASCII (`m/s^2`, `um`, `deg`) as it is shown in pictures and pages (`m/s²`, `µm`, `°`).
#[must_use]
pub fn pretty_unit(unit: &str) -> String {
    let mut text = unit.replace("^2", "²").replace("^3", "³").replace("^4", "⁴").replace('*', "·");
    for (ascii, pretty) in [("um", "µm"), ("us", "µs"), ("ohm", "Ω"), ("deg", "°")] {
        if let Some(rest) = text.strip_prefix(ascii)
            && !rest.starts_with(|c: char| c.is_alphabetic())
        {
            text = format!("{pretty}{rest}");
        }
    }
    text
}

/// Digits after the point that give `digits` significant ones, or `None` where the number is better written with an exponent.
fn decimals(x: f64, digits: i32) -> Option<usize> {
    if x == 0.0 {
        return Some(0);
    }
    if !x.is_finite() || !(1e-4..1e6).contains(&x.abs()) {
        return None;
    }
    usize::try_from((digits - 1 - exponent(x)).max(0)).ok()
}

fn exponent(x: f64) -> i32 {
    if x == 0.0 || !x.is_finite() { 0 } else { x.abs().log10().floor() as i32 }
}

fn trim(text: String) -> String {
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_keeps_four_digits() {
        for (x, text) in [
            (0.0, "0"),
            (0.07, "0.07"),
            (0.078_539_816, "0.07854"),
            (6.4137, "6.414"),
            (-0.5, "-0.5"),
            (12_346.2, "12346"),
            (999_999.0, "999999"),
            (1.3e6, "1.3e6"),
            (1.234_56e-7, "1.235e-7"),
            (1e-4, "0.0001"),
        ] {
            assert_eq!(short(x), text);
        }
    }

    #[test]
    fn what_is_printed_is_within_half_a_digit() {
        for k in -900..900 {
            let x = 1.037f64.powi(k) * if k % 2 == 0 { 1.0 } else { -1.0 };
            let back: f64 = short(x).parse().unwrap();
            // One part in 1e12 for the rounding of the decimal itself.
            assert!((back - x).abs() <= half_digit(x) + 1e-12 * x.abs(), "{x} printed {back}");
            assert_eq!(shortest(x).parse::<f64>().unwrap().to_bits(), x.to_bits());
        }
    }

    #[test]
    fn errors_carry_their_sign() {
        for (x, text) in
            [(0.0, "0"), (0.028_6, "+0.029"), (-1.34, "-1.3"), (12.3, "+12"), (2e7, "+2e7"), (3e-9, "+3e-9")]
        {
            assert_eq!(signed(x), text);
        }
    }

    #[test]
    fn units_are_shown_with_their_signs() {
        for (ascii, pretty) in [
            ("m/s^3", "m/s³"),
            ("um", "µm"),
            ("um/s", "µm/s"),
            ("N*m", "N·m"),
            ("use", "use"),
            ("s", "s"),
            ("deg/s", "°/s"),
        ] {
            assert_eq!(pretty_unit(ascii), pretty);
        }
    }
}
