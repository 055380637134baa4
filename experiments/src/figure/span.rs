//! What an axis spans and where its ticks stand.

/// An axis with ticks at the multiples of a step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) step: f64,
    decades: bool,
}

impl Span {
    /// Spans the finite logarithms of `values` by whole decades, with about `ticks` ticks at most.
    pub(crate) fn of_decades(logarithms: impl Iterator<Item = f64>, ticks: f64) -> Self {
        let (from, to) = bounds(logarithms);
        let (from, to) = (from.floor(), to.ceil().max(from.floor() + 1.0));
        let step = ((to - from) / ticks).ceil();
        Self { from, to, step, decades: true }
    }

    /// The same with a part of its length more at either end, and the same ticks.
    pub(crate) fn padded(self, part: f64) -> Self {
        let more = part * (self.to - self.from);
        Self { from: self.from - more, to: self.to + more, ..self }
    }

    /// Spans the finite `values` and `pad` of their range at either end, with about `ticks` ticks at most, a step of 1, 2
    /// or 5 times a power of ten apart. A flat line gets an axis around it.
    pub(crate) fn of(values: impl Iterator<Item = f64>, pad: f64, ticks: f64) -> Self {
        let (from, to) = bounds(values);
        let size = from.abs().max(to.abs());
        // Below this the difference is the rounding of the values.
        let half = if to - from > 1e-12 * size { 0.0 } else { if size > 0.0 { 0.5 * size } else { 0.5 } };
        let margin = half + pad * (to - from);
        let (from, to) = (from - margin, to + margin);
        let rough = (to - from) / ticks;
        let power = 10f64.powf(rough.log10().floor());
        let step =
            [1.0, 2.0, 5.0].into_iter().map(|k| k * power).find(|s| *s >= rough).unwrap_or(10.0 * power);
        Self { from, to, step, decades: false }
    }

    /// The same axis with at least this range, wider by as much on either side.
    pub(crate) fn widened(self, range: f64, ticks: f64) -> Self {
        let more = 0.5 * (range - (self.to - self.from)).max(0.0);
        Self::of([self.from - more, self.to + more].into_iter(), 0.0, ticks)
    }

    /// Where `x` stands, from 0 at the lower end to 1 at the upper.
    pub(crate) fn fraction(&self, x: f64) -> f64 {
        (x - self.from) / (self.to - self.from)
    }

    /// A tick as text: the same number of decimals on the whole axis, and a minus sign that is one.
    pub(crate) fn tick(&self, x: f64) -> String {
        if self.decades {
            return power_of_ten(x.round() as i32);
        }
        let x = if x.abs() < 1e-9 * self.step { 0.0 } else { x };
        let largest = self.from.abs().max(self.to.abs());
        let text = if largest >= 1e6 || self.step < 1e-5 {
            crate::number::short(x)
        } else {
            // A step of 0.05 has a logarithm of -1.3, which rounding may put on either side of a whole number at 0.01.
            let decimals = (-self.step.log10() - 1e-9).ceil().max(0.0) as usize;
            format!("{x:.decimals$}")
        };
        text.replace('-', "−")
    }
}

fn bounds(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)))
}

/// `10⁻³`; the powers that read as easily written out are.
fn power_of_ten(exponent: i32) -> String {
    match exponent {
        -2 => "0.01".to_owned(),
        -1 => "0.1".to_owned(),
        0 => "1".to_owned(),
        1 => "10".to_owned(),
        2 => "100".to_owned(),
        3 => "1000".to_owned(),
        _ => {
            let raised = |c: char| match c {
                '-' => '⁻',
                '1' => '¹',
                '2' => '²',
                '3' => '³',
                digit => digit.to_digit(10).and_then(|d| char::from_u32('⁰' as u32 + d)).unwrap_or(digit),
            };
            format!("10{}", exponent.to_string().chars().map(raised).collect::<String>())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(from: f64, to: f64) -> Span {
        Span::of([from, to].into_iter(), 0.0, 5.0)
    }

    #[test]
    fn steps_are_round_and_few() {
        for k in -200..200 {
            let (from, to) = (-1.1f64.powi(k), 3.0 * 1.07f64.powi(k));
            let span = of(from, to);
            let count = (to - from) / span.step;
            assert!((1.9..=5.0 + 1e-9).contains(&count), "{count} ticks from {from} to {to}");
            let mantissa = span.step / 10f64.powf((span.step.log10() + 1e-9).floor());
            assert!([1.0, 2.0, 5.0].iter().any(|m: &f64| (mantissa / m - 1.0).abs() < 1e-9), "{mantissa}");
        }
    }

    #[test]
    fn ticks_of_an_axis_have_the_same_decimals() {
        assert_eq!(
            ["0.00", "0.05", "0.10"],
            [0.0, 0.05, 0.1].map(|x| of(0.0, 0.2).tick(x)).each_ref().map(String::as_str)
        );
        assert_eq!(of(0.0, 0.05).tick(0.01), "0.01");
        assert_eq!(of(-12500.0, 12500.0).tick(-10000.0), "−10000");
        assert_eq!(of(-2e7, 1e7).tick(-1e7), "−1e7");
        assert_eq!(of(-4.0, 4.0).tick(-1e-15), "0");
    }

    #[test]
    fn a_padded_axis_keeps_its_ticks() {
        let padded = Span::of_decades([0.0, 2.0].into_iter(), 5.0).padded(0.05);
        assert_eq!((padded.from, padded.to, padded.step), (-0.1, 2.1, 1.0));
        assert_eq!(padded.tick(2.0), "100");
    }

    #[test]
    fn a_wider_axis_keeps_its_middle() {
        let wider = of(1.0, 3.0).widened(6.0, 5.0);
        assert_eq!((wider.from, wider.to), (-1.0, 5.0));
        let kept = of(1.0, 3.0).widened(0.5, 5.0);
        assert_eq!((kept.from, kept.to), (1.0, 3.0));
    }

    #[test]
    fn decades_are_whole() {
        let span = Span::of_decades([2.5e-4_f64, 0.3].map(f64::log10).into_iter(), 5.0);
        assert_eq!((span.from, span.to, span.step), (-4.0, 0.0, 1.0));
        assert_eq!(
            ["10⁻⁴", "0.01", "1"],
            [-4.0, -2.0, 0.0].map(|x| span.tick(x)).each_ref().map(String::as_str)
        );
        let wide = Span::of_decades([-13.2, 3.0].into_iter(), 5.0);
        assert_eq!((wide.from, wide.to, wide.step), (-14.0, 3.0, 4.0));
        assert_eq!(wide.tick(-12.0), "10⁻¹²");
        let flat = Span::of_decades([2.0].into_iter(), 5.0);
        assert_eq!((flat.from, flat.to), (2.0, 3.0));
    }

    #[test]
    fn a_flat_line_has_an_axis_around_it() {
        for level in [0.0, 3.0, -1e-6, 1e9] {
            let span = of(level, level);
            assert!(span.from < level && level < span.to && span.step > 0.0);
            assert!((span.fraction(level) - 0.5).abs() < 1e-9);
        }
    }
}
