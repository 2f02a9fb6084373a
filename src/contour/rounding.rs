//! How near to the level counts as on it.

use rustc_hash::FxHashMap as HashMap;

use crate::mesh::SimplexMesh;

/// How near to a level the coefficients around each mesh point count as on it.
///
/// A value is known to a few units in its last place, and a value that ought to be
/// zero, such as sin π, to a few units of its neighbours'. The neighbours are taken
/// around each point, not over the whole mesh: one huge value, such as a mark for
/// missing data, must not round off what is elsewhere. A point has one measure, so
/// all its cells agree on what lies on the level.
#[derive(Debug)]
pub struct Rounding {
    band: LevelBand,
    /// For each point of the active cells, the least spread of the bounds of the
    /// interpolant on one of them.
    spreads: HashMap<u32, f64>,
}

/// A level, and how far from it the walls are that count as on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LevelBand {
    /// The level.
    pub level: f64,
    /// How far from it values are on its walls; zero until that is known.
    pub of_walls: f64,
}

impl LevelBand {
    /// The level alone.
    pub fn new(level: f64) -> Self {
        Self { level, of_walls: 0.0 }
    }

    /// How far outside the range of a cell the level may be, and still be met in it: by rounding,
    /// or as the value of a wall.
    pub fn of_range(&self, range: [f64; 2]) -> f64 {
        of_range(range, self.level).max(self.of_walls)
    }
}

/// Rounding of a value itself.
const OF_VALUE: f64 = 4.0 * f64::EPSILON;

/// Rounding of a value that came of larger ones: those on a cell may be some tens
/// of times smaller than those that it came of.
const OF_SPREAD: f64 = 64.0 * f64::EPSILON;

/// Rounding of a value that was given, by a boundary condition, and went through a
/// file of single precision or a solver: 0.1 is then 0.100000001.
const OF_GIVEN: f64 = 1e-6;

impl Rounding {
    /// The rounding at the points of the cells that are active at a level, or at its walls; `bounds` are those by
    /// which a cell is active: by wider ones a point would be on the level for its neighbours,
    /// and not for a cell that is not among them.
    pub fn new<const CORNERS: usize>(
        mesh: &SimplexMesh<CORNERS>,
        bounds: impl Fn(usize) -> [f64; 2],
        band: LevelBand,
        cells: &[u32],
    ) -> Self {
        let mut spreads = HashMap::with_capacity_and_hasher(2 * cells.len(), Default::default());
        for &cell in cells {
            let [low, high] = bounds(cell as usize);
            for point in mesh.simplices()[cell as usize] {
                let least = spreads.entry(point).or_insert(f64::INFINITY);
                *least = least.min(high - low);
            }
        }
        Self { band, spreads }
    }

    /// That of values alone, without regard to what is around them.
    pub fn of_values(level: f64) -> Self {
        Self { band: LevelBand::new(level), spreads: HashMap::default() }
    }

    /// The level.
    pub fn level(&self) -> f64 {
        self.band.level
    }

    /// How near to the level coefficients at a point count as on it; `value` is the
    /// value there.
    pub fn at(&self, point: u32, value: f64) -> f64 {
        let spread = self.spread(point);
        (OF_VALUE * value.abs().max(self.level().abs())).max(OF_SPREAD * spread)
    }

    /// The same at a point of a wall, whose value is a given number.
    pub fn at_wall(&self, point: u32, value: f64) -> f64 {
        self.of_given(point, value).max(self.band.of_walls)
    }

    /// Whether a point may be on a wall that is on the level, by its value.
    pub fn may_be_on_wall(&self, point: u32, value: f64) -> bool {
        (value - self.level()).abs() <= self.at_wall(point, value)
    }

    /// Whether the value at a point may be the level, given as a number, without regard to
    /// other parts of its wall.
    pub fn is_on_level(&self, point: u32, value: f64) -> bool {
        (value - self.level()).abs() <= self.of_given(point, value)
    }

    /// How near to the level a value at a point counts as the level, given as a number.
    fn of_given(&self, point: u32, value: f64) -> f64 {
        OF_GIVEN * value.abs().max(self.level().abs()).max(self.spread(point))
    }

    fn spread(&self, point: u32) -> f64 {
        let spread = self.spreads.get(&point).copied().unwrap_or(0.0);
        if spread.is_finite() { spread } else { 0.0 }
    }
}

/// How near to a level coefficients of a cell with the given range may be and still count as on
/// it: as on an edge or inside a face. Its corners have [`of_range`].
pub fn of_coefficients([low, high]: [f64; 2], level: f64) -> f64 {
    let largest = low.abs().max(high.abs()).max(level.abs());
    (OF_VALUE * largest).max(OF_SPREAD * (high - low))
}

/// How far outside the range of a cell a level may be, to rounding, and still be
/// met in it.
pub fn of_range([low, high]: [f64; 2], level: f64) -> f64 {
    let largest = low.abs().max(high.abs()).max(level.abs());
    // the widest of the measures above; a cell that is met in vain does no harm
    OF_GIVEN * largest.max(high - low)
}
