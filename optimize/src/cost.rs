//! What an evaluation says of a candidate.

/// What an evaluation says of a candidate. Smaller is better: any cost is better than any violation, and any
/// violation is better than a failure, whatever their numbers.
///
/// ```
/// use optimize::Cost;
///
/// assert!(Cost::Ok(1e9) < Cost::Infeasible(0.1));
/// assert!(Cost::Infeasible(0.1) < Cost::Infeasible(0.2));
/// assert!(Cost::Infeasible(1e9) < Cost::Failed);
/// assert_eq!(Cost::from(f64::NAN), Cost::Failed);
/// ```
///
/// # References
/// K. Deb, "An efficient constraint handling method for genetic algorithms", Computer Methods in Applied Mechanics
/// and Engineering 186 (2000), <https://doi.org/10.1016/S0045-7825(99)00389-8>: the order.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Cost {
    /// The candidate may be used, at this cost; in the unit of the problem.
    Ok(f64),
    /// The candidate breaks a constraint, by this much; in the unit of the constraint.
    Infeasible(f64),
    /// The evaluation gave no answer.
    Failed,
}

impl Cost {
    /// The cost, if the candidate may be used.
    #[must_use]
    pub fn value(self) -> Option<f64> {
        match self {
            Self::Ok(cost) => Some(cost),
            Self::Infeasible(_) | Self::Failed => None,
        }
    }

    /// The same, with a number that is not finite taken for a failure: what is left is totally ordered.
    #[must_use]
    pub fn checked(self) -> Self {
        match self {
            Self::Ok(number) | Self::Infeasible(number) if !number.is_finite() => Self::Failed,
            checked => checked,
        }
    }
}

impl From<f64> for Cost {
    /// A cost; [`Cost::Failed`] if it is infinite or NaN.
    fn from(cost: f64) -> Self {
        Self::Ok(cost).checked()
    }
}

impl<E> From<Result<f64, E>> for Cost {
    /// A cost; [`Cost::Failed`] if there is none, or if it is infinite or NaN.
    fn from(cost: Result<f64, E>) -> Self {
        cost.map_or(Self::Failed, Self::from)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_two_costs_are_ordered() {
        let numbers = [f64::NEG_INFINITY, -1.0, 0.0, 2.0, f64::INFINITY, f64::NAN];
        let ok = numbers.map(|x| Cost::Ok(x).checked());
        let infeasible = numbers.map(|x| Cost::Infeasible(x).checked());
        let all: Vec<Cost> = ok.into_iter().chain(infeasible).collect();
        for a in &all {
            for b in &all {
                assert!(a.partial_cmp(b).is_some(), "{a:?} {b:?}");
            }
        }
        assert_eq!(all.iter().filter(|cost| **cost == Cost::Failed).count(), 6);
    }

    #[test]
    fn an_error_is_a_failure() {
        assert_eq!(Cost::from(Err::<f64, &str>("unstable")), Cost::Failed);
        assert_eq!(Cost::from(Ok::<f64, &str>(1.0)), Cost::Ok(1.0));
        assert_eq!(Cost::Infeasible(1.0).value(), None);
    }
}
