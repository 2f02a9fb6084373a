//! What the head of a file says about an array.

use super::array_type::ArrayType;
use super::error::ArrayError;
use super::xml::Node;

/// What the head of a file says about an array.
#[derive(Clone)]
pub(super) struct ArrayHead<'a> {
    pub(super) node: Node<'a>,
    pub(super) name: String,
    /// The type and the number of components, or what is wrong with them.
    pub(super) shape: Result<(ArrayType, usize), ArrayError>,
    pub(super) component_names: Vec<String>,
}

impl<'a> ArrayHead<'a> {
    /// Reads a `<DataArray>` or `<Array>` element.
    pub(super) fn read(node: Node<'a>) -> Self {
        Self {
            node,
            name: node.attribute("Name").unwrap_or_default().into_owned(),
            shape: shape(node),
            component_names: component_names(node),
        }
    }

    /// The arrays directly inside a section.
    pub(super) fn all_in(section: Node<'a>) -> impl Iterator<Item = Self> {
        let is_array = |node: &Node<'_>| matches!(node.name(), "DataArray" | "Array");
        section.children().filter(is_array).map(Self::read)
    }

    /// The number of tuples the head itself gives (field data do).
    pub(super) fn tuples(&self) -> Result<Option<usize>, ArrayError> {
        count(self.node, "NumberOfTuples")
    }
}

fn shape(node: Node<'_>) -> Result<(ArrayType, usize), ArrayError> {
    let name = node.attribute("type").unwrap_or_default();
    let kind = ArrayType::from_name(&name);
    let kind = kind.ok_or_else(|| ArrayError::UnknownType(name.into_owned()))?;
    // VTK takes 0 components as 1, and some writers rely on it.
    let components = count(node, "NumberOfComponents")?.unwrap_or(1).max(1);
    Ok((kind, components))
}

/// An attribute that is a count; `None` where it is missing.
fn count(node: Node<'_>, attribute: &'static str) -> Result<Option<usize>, ArrayError> {
    let Some(value) = node.attribute(attribute) else {
        return Ok(None);
    };
    match value.trim().parse() {
        Ok(count) => Ok(Some(count)),
        Err(_) => Err(ArrayError::BadAttribute { attribute, value: value.into_owned() }),
    }
}

fn component_names(node: Node<'_>) -> Vec<String> {
    let numbered = |(key, name): (&str, std::borrow::Cow<'_, str>)| {
        let number: usize = key.strip_prefix("ComponentName")?.parse().ok()?;
        Some((number, name.into_owned()))
    };
    let named: Vec<_> = node.attributes().filter_map(numbered).collect();
    // A forged number must not make a huge vector; real ones leave few gaps.
    let bound = 2 * named.len() + 8;
    let mut names = Vec::new();
    for (number, name) in named.into_iter().filter(|(number, _)| *number < bound) {
        if names.len() <= number {
            names.resize(number + 1, String::new());
        }
        if let Some(place) = names.get_mut(number) {
            *place = name;
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vtk::xml::Document;

    fn with_head(text: &str, check: impl Fn(ArrayHead<'_>)) {
        let document = Document::parse(text.as_bytes()).unwrap();
        check(ArrayHead::read(document.root(text.as_bytes())));
    }

    #[test]
    fn shapes_and_names() {
        let text = "<DataArray ComponentName2='z' ComponentName0='x' NumberOfComponents='3' \
                    Name='a&amp;b' type='Int16' NumberOfTuples='7'/>";
        with_head(text, |head| {
            assert_eq!(head.name, "a&b");
            assert_eq!(head.shape, Ok((ArrayType::I16, 3)));
            assert_eq!(head.component_names, ["x", "", "z"]);
            assert_eq!(head.tuples(), Ok(Some(7)));
        });
    }

    #[test]
    fn defaults() {
        with_head("<DataArray type='Float32' NumberOfComponents='0'/>", |head| {
            assert_eq!(head.name, "");
            assert_eq!(head.shape, Ok((ArrayType::F32, 1)));
            assert_eq!(head.tuples(), Ok(None));
        });
    }

    #[test]
    fn nonsense_is_kept_as_an_error() {
        with_head("<DataArray type='Float16'/>", |head| {
            assert_eq!(head.shape, Err(ArrayError::UnknownType("Float16".into())));
        });
        let text = "<DataArray type='Int8' NumberOfComponents='-3' ComponentName999999999='x'/>";
        with_head(text, |head| {
            assert!(matches!(head.shape, Err(ArrayError::BadAttribute { .. })));
            assert!(head.component_names.is_empty());
        });
    }
}
