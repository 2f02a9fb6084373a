//! All zeros of a cubic on the unit segment.
//!
//! The derivative's zeros cut the segment into at most three intervals on which
//! the cubic is monotone. The signs at their ends then say how many zeros there
//! are and of which kind; Newton's method, kept inside its interval, finds each.
//! Sign changes alone would miss double zeros and zeros at the ends: here a value
//! that is zero to rounding at an interval's end *is* a zero.

use arrayvec::ArrayVec;

use super::segment::SegmentCubic;
use super::sign::Sign;

/// The greatest number of isolated zeros of a cubic.
pub const MAX_ROOTS: usize = 3;

/// How a cubic behaves at one of its zeros.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RootKind {
    /// Odd multiplicity: the sign changes there.
    Crossing,
    /// Even multiplicity: the graph touches zero and turns back.
    Touch,
}

/// A zero of a cubic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root {
    /// Where, in `[0, 1]`.
    pub t: f64,
    /// Whether the sign changes there.
    pub kind: RootKind,
}

/// All zeros of a cubic on `[0, 1]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Roots {
    roots: ArrayVec<Root, MAX_ROOTS>,
    everywhere: bool,
    after_start: Sign,
}

/// A value counts as zero below this fraction of the largest coefficient. It
/// covers the rounding of de Casteljau's algorithm (a few units in the last
/// place) and of the critical point at which the value is taken.
const ZERO: f64 = 8.0 * f64::EPSILON;

/// A third of the least slope of a steep cubic, as a part of its change from end to end.
const STEEP: f64 = 1.0 / 64.0;

impl SegmentCubic {
    /// All zeros on `[0, 1]`, ascending.
    ///
    /// Zeros at the ends are found where the end coefficient is exactly zero.
    /// Two zeros closer than rounding can tell apart are reported as one
    /// [`RootKind::Touch`]. The answer does not depend on the direction of the
    /// segment: the zeros of [`SegmentCubic::reversed`] are `1 − t`, of the same
    /// kinds, and to the last bit whenever `1 − t` is exact.
    pub fn roots(&self) -> Roots {
        let reversed = self.reversed();
        if reversed.coefficients < self.coefficients {
            reversed.roots_forward().mirrored()
        } else {
            self.roots_forward()
        }
    }

    fn roots_forward(&self) -> Roots {
        let (low, high) = self.bounds();
        let mut roots = Roots::none(Sign::of(low));
        if low > 0.0 || high < 0.0 {
            return roots;
        }
        if low == 0.0 && high == 0.0 {
            roots.everywhere = true;
            return roots;
        }
        if self.is_steep() {
            // nearly always: no critical point need be looked for
            roots.push(Root { t: self.steep_root(), kind: RootKind::Crossing });
            roots.after_start = Sign::of(self.coefficients[0]);
            return roots;
        }
        let stations = Stations::of(self, ZERO * high.max(-low));
        stations.collect_roots(self, &mut roots);
        roots.after_start = stations.first_sign();
        roots
    }

    /// Whether the cubic crosses zero, and nowhere has a slope near zero or of the other
    /// sign, which its coefficients tell.
    fn is_steep(&self) -> bool {
        let [a, b, c, d] = self.coefficients;
        let (direction, least) = ((d - a).signum(), STEEP * (d - a).abs());
        let is_steep = |step: f64| step * direction >= least;
        a * d < 0.0 && is_steep(b - a) && is_steep(c - b) && is_steep(d - c)
    }

    /// The zero of a steep cubic.
    fn steep_root(&self) -> f64 {
        let [first, .., last] = self.coefficients;
        // a step s leaves an error of s² |p"/2p'|, where |p"| is no more than six times the change
        // from end to end, and p' no less than three times its part STEEP
        let is_last = |step: f64, t: f64| step * step / STEEP <= f64::EPSILON * t;
        self.newton([0.0, 1.0], first / (first - last), is_last)
    }

    /// The zero between `low` and `high`, where the signs differ and the cubic is monotone.
    fn root_between(&self, low: f64, high: f64) -> f64 {
        let is_last = |step: f64, t: f64| step.abs() <= f64::EPSILON * t;
        self.newton([low, high], 0.5 * (low + high), is_last)
    }

    /// Newton's method, with bisection where a step leaves the bracket; `is_last` tells whether a
    /// step from a place is short enough to be the last.
    fn newton(
        &self,
        [mut low, mut high]: [f64; 2],
        mut t: f64,
        is_last: impl Fn(f64, f64) -> bool,
    ) -> f64 {
        let rising = self.value(low) < 0.0;
        // Newton doubles the digits at each step; 64 halvings end any bracket.
        for _ in 0..64 {
            let value = self.value(t);
            if value == 0.0 {
                break;
            }
            if (value < 0.0) == rising {
                low = t;
            } else {
                high = t;
            }
            let newton = t - value / self.derivative(t);
            if is_last(newton - t, t) {
                // by rounding it may be outside, or nowhere else
                return newton.clamp(low, high);
            }
            t = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        }
        t
    }
}

/// The ends of the segment and the critical points between them, with the signs
/// of the values there (zero where the value is zero to rounding).
struct Stations {
    t: ArrayVec<f64, 4>,
    sign: ArrayVec<i8, 4>,
}

impl Stations {
    fn of(cubic: &SegmentCubic, zero: f64) -> Self {
        let mut stations = Stations { t: ArrayVec::new(), sign: ArrayVec::new() };
        let [first, .., last] = cubic.coefficients;
        stations.push(0.0, first, 0.0);
        for t in cubic.critical_points() {
            stations.push(t, cubic.value(t), zero);
        }
        stations.push(1.0, last, 0.0);
        stations
    }

    fn push(&mut self, t: f64, value: f64, zero: f64) {
        self.t.push(t);
        self.sign.push(if value.abs() <= zero { 0 } else { value.signum() as i8 });
    }

    /// The side on which the cubic lies just after the start.
    fn first_sign(&self) -> Sign {
        let first = self.sign.iter().find(|&&sign| sign != 0);
        Sign::of(f64::from(*first.unwrap_or(&0)))
    }

    fn collect_roots(&self, cubic: &SegmentCubic, roots: &mut Roots) {
        let mut i = 0;
        while i < self.sign.len() {
            let end = self.end_of_zeros(i);
            if end > i {
                roots.push(self.zero_root(cubic, i, end));
                i = end;
            } else {
                if i + 1 < self.sign.len() && self.sign[i] * self.sign[i + 1] < 0 {
                    let t = cubic.root_between(self.t[i], self.t[i + 1]);
                    roots.push(Root { t, kind: RootKind::Crossing });
                }
                i += 1;
            }
        }
    }

    /// One past the last of the consecutive zero stations that begin at `i`.
    fn end_of_zeros(&self, i: usize) -> usize {
        (i..self.sign.len()).find(|&j| self.sign[j] != 0).unwrap_or(self.sign.len())
    }

    /// The zero at the stations `begin..end`, which rounding cannot tell apart.
    fn zero_root(&self, cubic: &SegmentCubic, begin: usize, end: usize) -> Root {
        let at_start = begin == 0;
        let at_end = end == self.sign.len();
        if at_start || at_end {
            return Root { t: if at_start { 0.0 } else { 1.0 }, kind: end_kind(cubic, at_start) };
        }
        let changes = self.sign[begin - 1] != self.sign[end];
        let kind = if changes { RootKind::Crossing } else { RootKind::Touch };
        Root { t: 0.5 * (self.t[begin] + self.t[end - 1]), kind }
    }
}

/// The kind of a zero at an end: its multiplicity is the number of zero
/// coefficients before the first other one.
fn end_kind(cubic: &SegmentCubic, at_start: bool) -> RootKind {
    let [a, b, c, d] = cubic.coefficients;
    let inward = if at_start { [a, b, c, d] } else { [d, c, b, a] };
    let zeros = inward.iter().take_while(|&&value| value == 0.0).count();
    if zeros % 2 == 1 { RootKind::Crossing } else { RootKind::Touch }
}

impl Roots {
    fn none(after_start: Sign) -> Self {
        Roots { roots: ArrayVec::new(), everywhere: false, after_start }
    }

    fn push(&mut self, root: Root) {
        // three intervals hold at most three roots, and zero stations merge
        debug_assert!(!self.roots.is_full());
        let _ = self.roots.try_push(root);
    }

    fn mirrored(mut self) -> Self {
        self.after_start = self.before_end();
        self.roots.reverse();
        for root in &mut self.roots {
            root.t = 1.0 - root.t;
        }
        self
    }

    /// Whether the cubic is zero on the whole segment (then no root is listed).
    pub fn everywhere(&self) -> bool {
        self.everywhere
    }

    /// The side on which the cubic lies just after `t = 0`, whether or not it is
    /// zero there.
    pub fn after_start(&self) -> Sign {
        self.after_start
    }

    /// The side on which the cubic lies just before `t = 1`.
    pub fn before_end(&self) -> Sign {
        let inside = self.crossings().filter(|&t| t > 0.0 && t < 1.0).count();
        if inside % 2 == 0 { self.after_start } else { !self.after_start }
    }

    /// The zeros, ascending.
    pub fn as_slice(&self) -> &[Root] {
        &self.roots
    }

    /// The zeros at which the sign changes, ascending.
    pub fn crossings(&self) -> impl Iterator<Item = f64> + '_ {
        self.of_kind(RootKind::Crossing)
    }

    /// The zeros at which the graph touches zero without crossing it, ascending.
    pub fn touches(&self) -> impl Iterator<Item = f64> + '_ {
        self.of_kind(RootKind::Touch)
    }

    fn of_kind(&self, kind: RootKind) -> impl Iterator<Item = f64> + '_ {
        self.as_slice().iter().filter(move |root| root.kind == kind).map(|root| root.t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn cubic_with_roots(a: f64, b: f64, c: f64) -> SegmentCubic {
        // the blossom of (t-a)(t-b)(t-c) at 0s and 1s gives the coefficients
        let sum = a + b + c;
        let pairs = a * b + b * c + c * a;
        let product = a * b * c;
        SegmentCubic::new([
            -product,
            -product + pairs / 3.0,
            -product + 2.0 * pairs / 3.0 - sum / 3.0,
            1.0 - sum + pairs - product,
        ])
    }

    fn summary(cubic: SegmentCubic) -> Vec<(f64, RootKind)> {
        cubic.roots().as_slice().iter().map(|r| (r.t, r.kind)).collect()
    }

    use RootKind::{Crossing, Touch};

    #[test]
    fn one_crossing_of_a_straight_line() {
        let line = SegmentCubic::new([-1.0, -1.0 / 3.0, 1.0 / 3.0, 1.0]);
        assert_eq!(summary(line), [(0.5, Crossing)]);
    }

    #[test]
    fn three_crossings() {
        let roots = cubic_with_roots(0.25, 0.5, 0.75).roots();
        assert_eq!(roots.touches().count(), 0);
        for (found, exact) in roots.crossings().zip([0.25, 0.5, 0.75]) {
            assert!((found - exact).abs() < 1e-14, "{found} is not {exact}");
        }
        assert_eq!(roots.crossings().count(), 3);
    }

    #[test]
    fn a_double_root_is_a_touch() {
        let square = cubic_with_roots(0.5, 0.5, 2.0);
        assert_eq!(summary(square), [(0.5, Touch)]);
    }

    #[test]
    fn a_double_root_beside_a_crossing() {
        let found = summary(cubic_with_roots(0.25, 0.5, 0.5));
        let [(first, Crossing), (second, Touch)] = found[..] else { panic!("{found:?}") };
        assert!((first - 0.25).abs() < 1e-15 && (second - 0.5).abs() < 1e-7);
    }

    #[test]
    fn a_triple_root_is_a_crossing() {
        let [root] = summary(cubic_with_roots(0.5, 0.5, 0.5))[..] else { panic!("one root") };
        assert_eq!(root, (0.5, Crossing));
    }

    #[test]
    fn roots_at_the_ends() {
        assert_eq!(summary(SegmentCubic::new([0.0, 1.0, 1.0, 1.0])), [(0.0, Crossing)]);
        assert_eq!(summary(SegmentCubic::new([0.0, 0.0, 1.0, 1.0])), [(0.0, Touch)]);
        assert_eq!(summary(SegmentCubic::new([1.0, 0.0, 0.0, 0.0])), [(1.0, Crossing)]);
        assert_eq!(
            summary(SegmentCubic::new([0.0, 1.0, -1.0, 0.0])),
            [(0.0, Crossing), (0.5, Crossing), (1.0, Crossing)]
        );
    }

    #[test]
    fn zero_everywhere_and_nowhere() {
        assert!(SegmentCubic::new([0.0; 4]).roots().everywhere());
        assert_eq!(summary(SegmentCubic::new([0.0; 4])), []);
        assert_eq!(summary(SegmentCubic::new([1.0, 2.0, 1.0, 3.0])), []);
        // all of one sign, though the coefficients are not
        assert_eq!(summary(SegmentCubic::new([1.0, -0.5, 1.0, 1.0])), []);
    }

    #[test]
    fn two_crossings_closer_than_a_nanometre_of_a_metre() {
        let roots = cubic_with_roots(0.5 - 1e-7, 0.5 + 1e-7, 3.0).roots();
        assert_eq!(roots.crossings().count(), 2);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        /// Either direction of the segment gives the same zeros.
        #[test]
        fn direction_does_not_matter(c in prop::array::uniform4(-1.0..1.0f64)) {
            let forward = SegmentCubic::new(c).roots();
            let backward = SegmentCubic::new(c).reversed().roots();
            prop_assert_eq!(forward.as_slice().len(), backward.as_slice().len());
            for (f, b) in forward.as_slice().iter().zip(backward.as_slice().iter().rev()) {
                prop_assert_eq!(f.kind, b.kind);
                // one of them was computed, the other is its mirror image: bit for bit
                prop_assert!(f.t == 1.0 - b.t || b.t == 1.0 - f.t, "{} and {}", f.t, b.t);
            }
        }

        /// The value at every zero is zero to rounding.
        #[test]
        fn zeros_are_zeros(c in prop::array::uniform4(-1.0..1.0f64)) {
            let cubic = SegmentCubic::new(c);
            for root in cubic.roots().as_slice() {
                prop_assert!(cubic.value(root.t).abs() < 1e-14);
            }
        }

        /// As many crossings between any two points as their signs demand,
        /// and no sign change that a fine sampling sees is missed.
        #[test]
        fn nothing_is_missed(c in prop::array::uniform4(-1.0..1.0f64)) {
            let cubic = SegmentCubic::new(c);
            let crossings: Vec<f64> = cubic.roots().crossings().collect();
            let samples = 1000;
            let mut seen = 0;
            for i in 0..samples {
                let (a, b) = (i as f64 / samples as f64, (i + 1) as f64 / samples as f64);
                let inside = crossings.iter().filter(|&&t| t > a && t <= b).count();
                let changes = usize::from(cubic.value(a) * cubic.value(b) < 0.0);
                prop_assert_eq!(inside % 2, changes, "between {} and {}", a, b);
                seen += inside;
            }
            prop_assert_eq!(seen, crossings.len());
        }

        /// Known roots are found again, to the accuracy of their condition.
        #[test]
        fn known_roots(a in 0.0..1.0f64, b in 0.0..1.0f64, c in -2.0..3.0f64) {
            let mut expected: Vec<f64> =
                [a, b, c].into_iter().filter(|t| (0.0..=1.0).contains(t)).collect();
            expected.sort_by(f64::total_cmp);
            let apart = expected.windows(2).all(|w| w[1] - w[0] > 1e-3);
            prop_assume!(apart && expected.iter().all(|t| (1e-3..0.999).contains(t)));
            let found: Vec<f64> = cubic_with_roots(a, b, c).roots().crossings().collect();
            prop_assert_eq!(found.len(), expected.len());
            for (f, e) in found.iter().zip(&expected) {
                prop_assert!((f - e).abs() < 1e-9, "{} is not {}", f, e);
            }
        }
    }
}
