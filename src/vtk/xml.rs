//! The head of a VTK file: everything before the appended data, as a tree of elements.
//!
//! Only places in the file are kept: neither the text of inline arrays nor the
//! attributes are copied, so a head of any size costs a few words an element.

use quick_xml::Reader;
use quick_xml::events::attributes::Attributes;
use quick_xml::events::{BytesStart, Event};
use std::borrow::Cow;
use std::ops::Range;

/// More elements than any sensible file has; a guard against forged ones.
const MAX_ELEMENTS: usize = 1 << 18;

/// Elements whose insides tell us nothing and are not kept.
const SKIPPED: &str = "InformationKey";

/// One element; its descendants follow it in [`Document::elements`] up to `end`.
#[derive(Debug)]
struct Element {
    name: Range<usize>,
    attributes: Range<usize>,
    text: Range<usize>,
    end: usize,
}

/// Why the head could not be parsed.
#[derive(Debug, PartialEq)]
pub(super) enum XmlProblem {
    /// Not well formed, at this byte.
    Malformed { offset: u64, problem: String },
    /// The file ends inside this element.
    Unclosed { element: String },
    /// There is no element at all.
    Empty,
}

/// The parsed head.
#[derive(Debug)]
pub(super) struct Document {
    elements: Vec<Element>,
    appended: Option<usize>,
}

impl Document {
    /// Parses `bytes` up to `<AppendedData ...>` or the end of the document.
    pub(super) fn parse(bytes: &[u8]) -> Result<Self, XmlProblem> {
        // The reader would not count a byte order mark, so it does not see it.
        let start = if bytes.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
        let mut parser = Parser {
            reader: Reader::from_reader(bytes.get(start..).unwrap_or_default()),
            start,
            elements: Vec::new(),
            open: Vec::new(),
            appended: None,
            skipping: 0,
        };
        while parser.step(bytes)? {}
        parser.finish(bytes)
    }

    /// The outermost element.
    pub(super) fn root<'a>(&'a self, bytes: &'a [u8]) -> Node<'a> {
        Node { document: self, bytes, index: 0 }
    }

    /// The element `<AppendedData>` and the byte after its start tag.
    pub(super) fn appended<'a>(&'a self, bytes: &'a [u8]) -> Option<(Node<'a>, usize)> {
        let index = self.elements.len().checked_sub(1)?;
        let node = Node { document: self, bytes, index };
        Some((node, self.appended?))
    }
}

/// The state while parsing.
struct Parser<'a> {
    reader: Reader<&'a [u8]>,
    start: usize,
    elements: Vec<Element>,
    open: Vec<usize>,
    appended: Option<usize>,
    /// How many elements deep inside one that is skipped.
    skipping: usize,
}

impl Parser<'_> {
    /// Takes one event; returns whether more are to come.
    fn step(&mut self, bytes: &[u8]) -> Result<bool, XmlProblem> {
        let before = self.position();
        let event = self.reader.read_event().map_err(|error| {
            let offset = self.reader.error_position() + self.start as u64;
            // The reader gives no place for text that is not UTF-8.
            self.syntax_error(offset.max(before as u64), &error, bytes)
        })?;
        match event {
            Event::Start(tag) => return self.open_tag(&tag, true),
            Event::Empty(tag) => return self.open_tag(&tag, false),
            Event::End(_) => self.close_tag(),
            Event::Text(text) if self.skipping == 0 => self.text(before, &text),
            Event::DocType(_) => return Err(self.malformed("a document type is not allowed")),
            Event::Eof => return Ok(false),
            _ => {}
        }
        // Nothing after the root's end tag is of interest.
        Ok(!self.open.is_empty() || self.elements.is_empty())
    }

    /// The place of the next event, in bytes from the beginning of the file.
    fn position(&self) -> usize {
        // Positions in a slice always fit.
        self.reader.buffer_position() as usize + self.start
    }

    fn malformed(&self, problem: &str) -> XmlProblem {
        XmlProblem::Malformed { offset: self.position() as u64, problem: problem.to_owned() }
    }

    /// An error of the XML reader: at the end of the file it means a cut one.
    fn syntax_error(&self, offset: u64, error: &quick_xml::Error, bytes: &[u8]) -> XmlProblem {
        match error {
            quick_xml::Error::Syntax(_) if !self.open.is_empty() => self.unclosed(bytes),
            _ => XmlProblem::Malformed { offset, problem: error.to_string() },
        }
    }

    fn unclosed(&self, bytes: &[u8]) -> XmlProblem {
        let element = self.open.last().and_then(|index| self.elements.get(*index));
        let name = element.and_then(|element| bytes.get(element.name.clone()));
        XmlProblem::Unclosed {
            element: String::from_utf8_lossy(name.unwrap_or_default()).into_owned(),
        }
    }

    fn open_tag(&mut self, tag: &BytesStart<'_>, has_end: bool) -> Result<bool, XmlProblem> {
        if self.skipping > 0 || tag.name().as_ref() == SKIPPED {
            self.skipping += usize::from(has_end);
            return Ok(true);
        }
        self.check_tag(tag)?;
        let element = self.element(tag, has_end);
        let end_of_tag = element.text.start;
        if has_end {
            self.open.push(self.elements.len());
        }
        self.elements.push(element);
        if has_end && tag.name().as_ref() == "AppendedData" {
            self.appended = Some(end_of_tag);
            return Ok(false);
        }
        Ok(!self.open.is_empty())
    }

    fn check_tag(&self, tag: &BytesStart<'_>) -> Result<(), XmlProblem> {
        if self.elements.len() >= MAX_ELEMENTS {
            return Err(self.malformed("more elements than a VTK file has"));
        }
        let mut attributes = tag.attributes();
        // The check for repeated names costs the square of their number.
        let attributes = attributes.with_checks(false);
        match attributes.find_map(Result::err) {
            Some(error) => Err(self.malformed(&error.to_string())),
            None => Ok(()),
        }
    }

    /// The element of a start tag that has just been read.
    fn element(&self, tag: &BytesStart<'_>, has_end: bool) -> Element {
        let after = self.position();
        let slash = usize::from(!has_end);
        let end = after.saturating_sub(1 + slash);
        let start = end.saturating_sub(tag.len());
        let name_end = start + tag.name().as_ref().len();
        Element {
            name: start..name_end,
            attributes: name_end..end,
            text: after..after,
            end: self.elements.len() + 1,
        }
    }

    fn close_tag(&mut self) {
        if self.skipping > 0 {
            self.skipping -= 1;
            return;
        }
        let end = self.elements.len();
        let index = self.open.pop();
        if let Some(element) = index.and_then(|index| self.elements.get_mut(index)) {
            element.end = end;
        }
    }

    /// Keeps the place of an element's first text that is not blank.
    fn text(&mut self, place: usize, text: &str) {
        let index = self.open.last().copied();
        let element = index.and_then(|index| self.elements.get_mut(index));
        if let Some(element) = element
            && element.text.is_empty()
            && !text.bytes().all(|byte| byte.is_ascii_whitespace())
        {
            element.text = place..place + text.len();
        }
    }

    fn finish(self, bytes: &[u8]) -> Result<Document, XmlProblem> {
        if self.elements.is_empty() {
            return Err(XmlProblem::Empty);
        }
        if self.appended.is_none() && !self.open.is_empty() {
            return Err(self.unclosed(bytes));
        }
        let mut elements = self.elements;
        let count = elements.len();
        for index in self.open {
            if let Some(element) = elements.get_mut(index) {
                element.end = count;
            }
        }
        Ok(Document { elements, appended: self.appended })
    }
}

/// One element of the head.
#[derive(Clone, Copy)]
pub(super) struct Node<'a> {
    document: &'a Document,
    bytes: &'a [u8],
    index: usize,
}

impl<'a> Node<'a> {
    fn element(&self) -> Option<&'a Element> {
        self.document.elements.get(self.index)
    }

    fn slice(&self, range: impl Fn(&Element) -> Range<usize>) -> &'a str {
        let bytes = self.element().and_then(|e| self.bytes.get(range(e)));
        // The reader has checked that tags are UTF-8.
        std::str::from_utf8(bytes.unwrap_or_default()).unwrap_or_default()
    }

    /// The element's name.
    pub(super) fn name(&self) -> &'a str {
        self.slice(|element| element.name.clone())
    }

    /// The attributes in order, unescaped.
    pub(super) fn attributes(&self) -> impl Iterator<Item = (&'a str, Cow<'a, str>)> {
        let mut attributes = Attributes::new(self.slice(|element| element.attributes.clone()), 0);
        attributes.with_checks(false);
        attributes.filter_map(Result::ok).map(|attribute| {
            let value = attribute.normalized_value(quick_xml::XmlVersion::Implicit1_0);
            // VTK 9.7 itself writes '&' in names as it stands.
            let value = value.unwrap_or(attribute.value);
            (attribute.key.into_inner(), value)
        })
    }

    /// The value of an attribute.
    pub(super) fn attribute(&self, name: &str) -> Option<Cow<'a, str>> {
        self.attributes().find(|(key, _)| *key == name).map(|(_, value)| value)
    }

    /// The place of the text in the file; empty where there is none.
    pub(super) fn text(&self) -> Range<usize> {
        self.element().map_or(0..0, |element| element.text.clone())
    }

    /// The elements directly inside.
    pub(super) fn children(&self) -> impl Iterator<Item = Node<'a>> + use<'a> {
        let (document, bytes) = (self.document, self.bytes);
        let end = self.element().map_or(0, |element| element.end);
        let mut next = self.index + 1;
        std::iter::from_fn(move || {
            if next >= end {
                return None;
            }
            let index = next;
            next = document.elements.get(index)?.end;
            Some(Node { document, bytes, index })
        })
    }

    /// As [`children`](Self::children), for where the node itself is given away.
    pub(super) fn into_children(self) -> impl Iterator<Item = Node<'a>> + use<'a> {
        self.children()
    }

    /// The first element directly inside that has this name.
    pub(super) fn child(&self, name: &str) -> Option<Node<'a>> {
        self.children().find(|child| child.name() == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(node: Node<'_>) -> Vec<&str> {
        node.children().map(|child| child.name()).collect()
    }

    #[test]
    fn tree_attributes_and_text() {
        let bytes =
            b"\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<!-- <x> --><a k='1' n = \"x&lt;&quot;y\">\
            <b> <!-- c --> 1 2 <InformationKey><b/></InformationKey> </b><c/><d><e/></d></a>\n";
        let document = Document::parse(bytes).unwrap();
        let root = document.root(bytes);
        assert_eq!(root.name(), "a");
        assert_eq!(root.attribute("n").unwrap(), "x<\"y");
        assert_eq!(root.attribute("missing"), None);
        assert_eq!(names(root), ["b", "c", "d"]);
        assert_eq!(&bytes[root.child("b").unwrap().text()], b" 1 2 ");
        assert_eq!(names(root.child("d").unwrap()), ["e"]);
        assert!(root.child("c").unwrap().text().is_empty());
        assert!(document.appended(bytes).is_none());
    }

    #[test]
    fn parsing_stops_at_the_appended_data() {
        let bytes = b"<a><b/><AppendedData encoding='raw'> _\x00<<&\xFF";
        let document = Document::parse(bytes).unwrap();
        let (node, at) = document.appended(bytes).unwrap();
        assert_eq!(node.attribute("encoding").unwrap(), "raw");
        assert_eq!(bytes[at..][..2], *b" _");
        assert_eq!(names(document.root(bytes)), ["b", "AppendedData"]);
    }

    #[test]
    fn unescaped_names_of_vtk_are_taken_as_they_are() {
        let bytes = b"<a Name=\"a & b<c\"/>";
        let document = Document::parse(bytes).unwrap();
        assert_eq!(document.root(bytes).attribute("Name").unwrap(), "a & b<c");
    }

    #[test]
    fn cut_and_broken_documents_are_told_apart() {
        let problem = |text: &str| Document::parse(text.as_bytes()).unwrap_err();
        assert_eq!(problem(""), XmlProblem::Empty);
        assert_eq!(problem("  \n"), XmlProblem::Empty);
        let unclosed = |name: &str| XmlProblem::Unclosed { element: name.to_owned() };
        assert_eq!(problem("<a><b>1 2"), unclosed("b"));
        assert_eq!(problem("<a><b>1</b><c k='"), unclosed("a"));
        assert!(matches!(problem("<a></b>"), XmlProblem::Malformed { .. }));
        assert!(matches!(problem("<a k=></a>"), XmlProblem::Malformed { .. }));
    }

    #[test]
    fn deep_and_long_documents_neither_overflow_nor_grow() {
        assert!(Document::parse("<a>".repeat(100_000).as_bytes()).is_err());
        let many = format!("<a>{}</a>", "<b/>".repeat(MAX_ELEMENTS));
        assert!(matches!(Document::parse(many.as_bytes()), Err(XmlProblem::Malformed { .. })));
    }
}
