//! Derivatives along the arc, from those by any parameter.

use super::enclosure::Scalar;

/// The point and four derivatives.
pub(super) const ORDERS: usize = 5;

/// Taylor coefficients of a function of the parameter: `f^(k) / k!`.
pub(super) type Jet<T> = [T; ORDERS];

/// The Taylor coefficients of every coordinate.
pub(super) type Coordinates<T, const D: usize> = [Jet<T>; D];

/// Unit tangent and its derivatives by the arc length `s`: `dr/ds` to `d^4 r/ds^4`.
pub(super) type ArcDerivatives<T, const D: usize> = [[T; D]; ORDERS - 1];

/// The derivatives of a path by its arc length, from the Taylor coefficients of its coordinates:
///
/// `dr/ds = r' / |r'|`, and `d/ds = (1 / |r'|) d/du` again and again.
///
/// `None` where the speed `|r'|` may be zero.
pub(super) fn along_arc<T: Scalar, const D: usize>(
    coordinates: &Coordinates<T, D>,
) -> Option<(T, ArcDerivatives<T, D>)> {
    let velocity = coordinates.each_ref().map(derivative);
    let mut square = [T::ZERO; ORDERS];
    for component in &velocity {
        let own = product(component, component);
        square.iter_mut().zip(own).for_each(|(sum, x)| *sum = *sum + x);
    }
    // The product does not know that both factors are the same number.
    let [speed_square, ..] = &mut square;
    *speed_square = velocity.iter().fold(T::ZERO, |sum, [first, ..]| sum + first.square());
    let least = *speed_square;
    let slowness = inverse_root(&square)?;
    let [inverse_speed, ..] = slowness;

    let mut along = [[T::ZERO; D]; ORDERS - 1];
    let mut jets = velocity.each_ref().map(|v| product(v, &slowness));
    for (order, values) in along.iter_mut().enumerate() {
        if order > 0 {
            jets = jets.each_ref().map(|jet| product(&derivative(jet), &slowness));
        }
        *values = jets.map(|[value, ..]| value);
    }
    Some((least * inverse_speed, along))
}

/// The Taylor coefficients of a quotient.
pub(super) fn quotient<T: Scalar>(numerator: &Jet<T>, denominator: &Jet<T>) -> Option<Jet<T>> {
    let [first, rest @ ..] = denominator;
    let inverse = first.inverse()?;
    let mut result = [T::ZERO; ORDERS];
    for (order, above) in numerator.iter().enumerate() {
        let (known, unknown) = result.split_at_mut(order);
        let carried = known.iter().rev().zip(rest).fold(*above, |sum, (x, w)| sum - *x * *w);
        if let Some(next) = unknown.first_mut() {
            *next = carried * inverse;
        }
    }
    Some(result)
}

/// The coefficients of the derivative; the last one is not known and zero.
fn derivative<T: Scalar>(jet: &Jet<T>) -> Jet<T> {
    let mut result = [T::ZERO; ORDERS];
    for (order, (to, from)) in result.iter_mut().zip(jet.iter().skip(1)).enumerate() {
        *to = *from * T::from_f64((order + 1) as f64);
    }
    result
}

fn product<T: Scalar>(a: &Jet<T>, b: &Jet<T>) -> Jet<T> {
    let mut result = [T::ZERO; ORDERS];
    for (order, sum) in result.iter_mut().enumerate() {
        let pairs = a.iter().take(order + 1).rev().zip(b);
        *sum = pairs.fold(T::ZERO, |sum, (x, y)| sum + *x * *y);
    }
    result
}

/// `a^(-1/2)`: `n a_0 p_n = sum over k from 1 to n of (-k/2 - (n - k)) a_k p_(n-k)`.
fn inverse_root<T: Scalar>(a: &Jet<T>) -> Option<Jet<T>> {
    let [first, rest @ ..] = a;
    let (root, inverse) = (first.inverse_root()?, first.inverse()?);
    let mut result = [T::ZERO; ORDERS];
    for order in 0..ORDERS {
        let (known, unknown) = result.split_at_mut(order);
        let Some(next) = unknown.first_mut() else { break };
        if order == 0 {
            *next = root;
            continue;
        }
        let terms = known.iter().rev().zip(rest).enumerate();
        let sum = terms.fold(T::ZERO, |sum, (index, (p, a))| {
            let k = (index + 1) as f64;
            sum + *p * *a * T::from_f64(0.5 * k - order as f64)
        });
        *next = sum * inverse * T::from_f64(1.0 / order as f64);
    }
    Some(result)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_circle_run_through_unevenly_has_its_derivatives() {
        // r = (cos g, sin g) with g = u + u^2/2 about u = 0, coefficients by hand.
        let x = [1.0, 0.0, -0.5, -0.5, -0.125 + 1.0 / 24.0];
        let y = [0.0, 1.0, 0.5, -1.0 / 6.0, -0.25];
        let (speed, [t, k, b, c]) = along_arc(&[x, y]).expect("regular");
        assert!((speed - 1.0).abs() < 1e-15);
        for (found, wanted) in [(t, [0.0, 1.0]), (k, [-1.0, 0.0]), (b, [0.0, -1.0]), (c, [1.0, 0.0])] {
            for (a, b) in found.iter().zip(wanted) {
                assert!((a - b).abs() < 1e-14, "{found:?} for {wanted:?}");
            }
        }
    }

    #[test]
    fn a_quotient_of_series_is_the_series_of_the_quotient() {
        // (1 + u)^3 / (1 + u) = 1 + 2 u + u^2.
        let found = quotient(&[1.0, 3.0, 3.0, 1.0, 0.0], &[1.0, 1.0, 0.0, 0.0, 0.0]);
        assert_eq!(found, Some([1.0, 2.0, 1.0, 0.0, 0.0]));
        assert_eq!(quotient(&[1.0; 5], &[0.0; 5]), None);
    }
}
