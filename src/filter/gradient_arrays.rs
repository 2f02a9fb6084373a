//! Point arrays that may hold the gradient of another, by their names.

use super::chosen_array::{ChosenArray, Component};
use crate::mesh::Vector;
use crate::simplices::vectors;
use crate::vtk::{DataArray, UnstructuredGrid};

/// A gradient: an array of vectors, or its components as two or three arrays.
#[derive(Clone, Debug)]
pub struct GradientArrays<'a> {
    arrays: Vec<&'a DataArray>,
    /// Whether the name says whose gradient it is, or is "gradient" and no more; else it
    /// has the word in it somewhere.
    pub is_certain: bool,
}

/// The words for a gradient.
const WORDS: [&str; 5] = ["gradients", "gradient", "grad", "nabla", "∇"];

impl<'a> GradientArrays<'a> {
    /// The array of a name; else, for a name like `ux,uy`, the arrays between its commas.
    pub fn named(grid: &'a UnstructuredGrid, name: &str) -> Option<Self> {
        let arrays = match grid.point_data.get(name) {
            Some(array) => vec![array],
            None => components(name.split(',').map(|part| grid.point_data.get(part.trim())))?,
        };
        Some(Self { arrays, is_certain: true })
    }

    /// What may be the gradient of the array `name`: first what names it, then what is
    /// called gradient and no more, then what has that in its name and names no other
    /// array.
    pub fn conventional(grid: &'a UnstructuredGrid, name: &str) -> Vec<Self> {
        let wanted = plain(name);
        let arrays = || grid.point_data.iter().map(|array| (plain(&array.name), array));
        let one = |array, is_certain| Self { arrays: vec![array], is_certain };
        let names_it = |found: &str| {
            let by_word = WORDS
                .iter()
                .any(|w| *found == format!("{w}{wanted}") || *found == format!("{wanted}{w}"));
            by_word || *found == format!("d{wanted}")
        };
        let is_other = |found: &str| {
            let others = arrays().filter(|(other, _)| *other != wanted && other != found);
            let rest = WORDS.iter().fold(found.to_owned(), |rest, word| rest.replace(word, ""));
            others.into_iter().any(|(other, _)| other == rest)
        };
        let specific = arrays().filter(|(found, _)| names_it(found));
        let bare = arrays().filter(|(found, _)| WORDS.contains(&found.as_str()));
        let loose = arrays().filter(|(found, _)| {
            let has_word = WORDS.iter().any(|word| found.contains(word));
            has_word && !names_it(found) && !WORDS.contains(&found.as_str()) && !is_other(found)
        });
        let mut candidates: Vec<Self> = specific.map(|(_, array)| one(array, true)).collect();
        candidates.extend(Self::of_components(grid, &wanted));
        candidates.extend(bare.map(|(_, array)| one(array, true)));
        candidates.extend(loose.map(|(_, array)| one(array, false)));
        candidates
    }

    /// Components under names such as `ux uy`, `u_x u_y`, `dudx dudy` or `du/dx du/dy`.
    fn of_components(grid: &'a UnstructuredGrid, wanted: &str) -> Option<Self> {
        let find = |name: String| grid.point_data.iter().find(|array| plain(&array.name) == name);
        let names: [fn(&str, char) -> String; 3] = [
            |wanted, axis| format!("{wanted}{axis}"),
            |wanted, axis| format!("d{wanted}d{axis}"),
            |wanted, axis| format!("grad{wanted}{axis}"),
        ];
        let of_names = |name: fn(&str, char) -> String| {
            let [x, y, z] = ['x', 'y', 'z'].map(|axis| find(name(wanted, axis)));
            components([x, y].into_iter().chain(z.map(Some)))
        };
        let arrays = names.into_iter().find_map(of_names)?;
        Some(Self { arrays, is_certain: true })
    }

    /// The names, with commas between.
    pub fn name(&self) -> String {
        let names: Vec<&str> = self.arrays.iter().map(|array| array.name.as_str()).collect();
        names.join(",")
    }

    /// How many components there are.
    pub fn components(&self) -> usize {
        self.arrays.iter().map(|array| array.components).sum()
    }

    /// The gradient of what is chosen, from components of its shape: three (or two) for a
    /// scalar, three for each component of a vector.
    pub fn vectors(&self, chosen: &ChosenArray) -> Option<Vec<Vector>> {
        let [array] = self.arrays[..] else { return self.joined(chosen) };
        let of_vector = chosen.array.components > 1;
        match chosen.component {
            Some(Component::Magnitude) if of_vector => None,
            Some(Component::Number(component)) if of_vector => {
                let whole = array.components == 3 * chosen.array.components;
                let start = 3 * component;
                let part = |n: usize| array.component(start + n).filter(|_| whole);
                let (x, y, z) = (part(0)?, part(1)?, part(2)?);
                Some((0..x.len()).map(|n| Vector::new(x[n], y[n], z[n])).collect())
            }
            _ => vectors(array),
        }
    }

    /// Arrays of one component each, side by side; for a scalar only.
    fn joined(&self, chosen: &ChosenArray) -> Option<Vec<Vector>> {
        if chosen.array.components > 1 {
            return None;
        }
        let axes: Vec<Vec<f64>> =
            self.arrays.iter().map(|array| array.component(0)).collect::<Option<_>>()?;
        let at =
            |n: usize| Vector::from_fn(|axis, _| axes.get(axis).map_or(0.0, |values| values[n]));
        Some((0..axes[0].len()).map(at).collect())
    }
}

/// Two or three arrays of one component, if all are there.
fn components<'a>(
    arrays: impl Iterator<Item = Option<&'a DataArray>>,
) -> Option<Vec<&'a DataArray>> {
    let arrays: Vec<&DataArray> = arrays.collect::<Option<_>>()?;
    let fit = (2..=3).contains(&arrays.len()) && arrays.iter().all(|array| array.components == 1);
    fit.then_some(arrays)
}

/// A name without case and without what joins its parts.
pub fn plain(name: &str) -> String {
    name.to_lowercase().chars().filter(|c| !"_-/. ()[]{}".contains(*c)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(arrays: &[(&str, usize)]) -> UnstructuredGrid {
        let mut grid = UnstructuredGrid::new(DataArray::new("Points", 3, vec![0.0; 3]));
        for &(name, components) in arrays {
            grid.point_data.push(DataArray::new(name, components, vec![1.0; components]));
        }
        grid
    }

    fn found(arrays: &[(&str, usize)]) -> Vec<String> {
        let grid = grid(arrays);
        GradientArrays::conventional(&grid, "u").iter().map(GradientArrays::name).collect()
    }

    #[test]
    fn usual_names_are_found() {
        for name in ["du", "ScalarGradient", "grad(u)", "∇u", "u_gradient", "Gradients", "grad u"]
        {
            assert_eq!(found(&[("u", 1), (name, 3)]), [name]);
        }
        let pairs = [["ux", "uy"], ["u_x", "u_y"], ["dudx", "dudy"], ["du/dx", "du/dy"]];
        for [x, y] in pairs {
            assert_eq!(found(&[("u", 1), (x, 1), (y, 1)]), [format!("{x},{y}")]);
        }
        assert_eq!(found(&[("u", 1), ("uz", 1), ("uy", 1), ("ux", 1)]), ["ux,uy,uz"]);
    }

    #[test]
    fn what_names_it_comes_first_and_others_gradients_not_at_all() {
        let arrays = [("u", 1), ("v", 1), ("grad_v", 3), ("temperature_gradient", 3)];
        let more = [("gradient", 3), ("grad_u", 3), ("ux", 1)];
        let expected = ["grad_u", "gradient", "temperature_gradient"];
        assert_eq!(found(&[&arrays[..], &more].concat()), expected);
    }

    #[test]
    fn components_side_by_side() {
        let grid = grid(&[("u", 1), ("a", 1), ("b", 1), ("v", 3)]);
        let chosen = ChosenArray { array: grid.point_data.get("u").unwrap(), component: None };
        let arrays = GradientArrays::named(&grid, "a, b").unwrap();
        assert_eq!(arrays.vectors(&chosen).unwrap(), [Vector::new(1.0, 1.0, 0.0)]);
        assert!(GradientArrays::named(&grid, "a,nothing").is_none());
        assert!(GradientArrays::named(&grid, "a,v").is_none());
    }
}
