//! What contouring a file would do, for `info`.

use anyhow::Result;
use vtu2contour::filter::{ContourOptions, GradientOrigin, Preview, preview};

use super::input::{Arrays, Input};
use super::warnings::Warnings;

/// What contouring all parts of an input would do.
#[derive(Default)]
pub struct Plan {
    parts: Vec<Preview>,
    /// Why parts cannot be contoured.
    refusals: Warnings,
    /// What would be left out.
    left_out: Warnings,
    notes: Warnings,
}

impl Plan {
    /// Reads every part.
    pub fn new(input: &Input, options: &ContourOptions) -> Result<Self> {
        let mut plan = Self::default();
        for part in &input.parts {
            let name = input.name(part);
            let grid = input.read(part, Arrays::Needed(options))?.data;
            match preview(&grid, options) {
                Ok(found) => plan.add(name.as_deref(), found),
                Err(error) => plan.refusals.add(name.as_deref(), &error.to_string()),
            }
        }
        Ok(plan)
    }

    fn add(&mut self, name: Option<&str>, found: Preview) {
        let counts = [
            (found.unusable, "triangles and tetrahedra with values not finite"),
            (found.ghosts, "triangles and tetrahedra of ghost cells"),
        ];
        if found.left_out.total() > 0 {
            self.left_out.add(name, &found.left_out.to_string());
        }
        for (count, what) in counts.into_iter().filter(|(count, _)| *count > 0) {
            self.left_out.add(name, &format!("{count} {what}"));
        }
        if found.folded.total() > 0 {
            self.notes.add(name, &format!("{} fold over themselves", found.folded));
        }
        if let Some(warning) = &found.warning {
            self.notes.add(name, warning);
        }
        self.parts.push(found);
    }

    /// A line each. `count`: how many parts the input has.
    pub fn lines(&self, options: &ContourOptions, count: usize) -> Vec<String> {
        let mut lines = self.summary(options);
        lines.extend(self.left_out.lines(count).map(|line| format!("left out  {line}")));
        lines.extend(self.notes.lines(count).map(|line| format!("note      {line}")));
        lines.extend(self.refusals.lines(count));
        lines
    }

    /// What would be contoured, and at which levels.
    fn summary(&self, options: &ContourOptions) -> Vec<String> {
        let Some(first) = self.parts.first() else { return Vec::new() };
        let gradient = |part: &Preview| match &part.gradient {
            GradientOrigin::Array(name) => name.clone(),
            other => other.to_string(),
        };
        let mut gradients: Vec<String> = self.parts.iter().map(gradient).collect();
        gradients.sort();
        gradients.dedup();
        let triangles: usize = self.parts.iter().map(|part| part.triangles).sum();
        let tetrahedra: usize = self.parts.iter().map(|part| part.tetrahedra).sum();
        let cells = match (triangles, tetrahedra) {
            (_, 0) => format!("{triangles} triangles"),
            (0, _) => format!("{tetrahedra} tetrahedra"),
            _ => format!("{triangles} triangles, {tetrahedra} tetrahedra"),
        };
        let low = self.parts.iter().map(|part| part.range[0]).fold(f64::INFINITY, f64::min);
        let high = self.parts.iter().map(|part| part.range[1]).fold(f64::NEG_INFINITY, f64::max);
        let mut lines = vec![
            format!("array     {}", first.label),
            format!("gradient  {}", gradients.join(" or ")),
            format!("cells     {cells}"),
            format!("range     {low:?} to {high:?}"),
        ];
        let levels = options.levels.resolve([low, high]).unwrap_or_default();
        lines.push(match &levels[..] {
            [first, .., last] => {
                format!("levels    {} by default, from {first:?} to {last:?}", levels.len())
            }
            _ => "levels    none by default: the values are all the same".to_owned(),
        });
        lines
    }
}
