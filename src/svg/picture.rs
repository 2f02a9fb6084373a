//! A picture: an outline, coloured lines, a title and a colour bar.

use std::io::{self, Write};

use super::colour_bar::{Place, colour_bar, fraction, number};
use super::colour_map::viridis;
use super::path::{Curve, Point, path_data, straight};

/// A line with a value.
#[derive(Clone, Debug)]
pub struct Coloured {
    /// The value: its colour, and what the mouse is told.
    pub value: f64,
    /// The line's pieces, in order.
    pub curves: Vec<Curve>,
    /// Whether its end joins its start.
    pub closed: bool,
}

/// Lines in the plane with x to the right and y *up*, in any unit: they are scaled
/// to fit the page.
#[derive(Clone, Debug, Default)]
pub struct Picture {
    /// What is shown; stands above the colour bar.
    pub title: String,
    /// Values of the colour bar, ascending.
    pub values: Vec<f64>,
    /// Faint lines behind all others: the mesh.
    pub mesh: Vec<[Point; 2]>,
    /// Grey lines: the boundary.
    pub outline: Vec<[Point; 2]>,
    /// The lines.
    pub lines: Vec<Coloured>,
}

/// The longer side of the drawing, in user units (CSS pixels).
const SIZE: f64 = 720.0;
const MARGIN: f64 = 20.0;
/// The place for the colour bar and its labels; more if the title is longer.
const BAR: f64 = 110.0;
/// From the drawing to the bar.
const BEFORE_BAR: f64 = 24.0;
/// The width of a bold letter of the title; wide ones are wider, narrow ones narrower.
const LETTER: f64 = 8.0;

impl Picture {
    /// Writes the picture as an SVG document.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, mut out: impl Write) -> io::Result<()> {
        let view = View::of(self);
        let (width, height) =
            (view.width + 2.0 * MARGIN + self.bar_width(), view.height + 2.0 * MARGIN);
        writeln!(
            out,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\" \
             width=\"{width:.0}\" height=\"{height:.0}\" font-family=\"sans-serif\" \
             font-size=\"12\" fill=\"#333\">\n<title>{}</title>\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>",
            escaped(&self.title)
        )?;
        self.write_straight(&mut out, &view, &self.mesh, "#dcdcdc", 0.6)?;
        self.write_straight(&mut out, &view, &self.outline, "#888", 1.0)?;
        self.write_lines(&mut out, &view)?;
        self.write_bar(&mut out, width, height)?;
        writeln!(out, "</svg>")
    }

    fn write_straight(
        &self,
        out: &mut impl Write,
        view: &View,
        segments: &[[Point; 2]],
        colour: &str,
        width: f64,
    ) -> io::Result<()> {
        if segments.is_empty() {
            return Ok(());
        }
        write!(out, "<path fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" d=\"")?;
        for [a, b] in segments {
            let [a, b] = [view.place(a), view.place(b)];
            write!(out, "{}", path_data(&[straight(a, b)], false))?;
        }
        writeln!(out, "\"/>")
    }

    /// One group a value, one path a line.
    fn write_lines(&self, out: &mut impl Write, view: &View) -> io::Result<()> {
        let (low, high) = self.ends();
        let open = "<g fill=\"none\" stroke-width=\"1.5\" stroke-linejoin=\"round\" stroke-linecap=\"round\"";
        for lines in self.lines.chunk_by(|a, b| a.value == b.value) {
            let value = lines[0].value;
            let colour = viridis(fraction(value, low, high));
            writeln!(out, "{open} stroke=\"{colour}\"><title>{}</title>", number(value))?;
            for line in lines {
                let placed = |curve: &Curve| curve.map(|point| view.place(&point));
                let curves: Vec<Curve> = line.curves.iter().map(placed).collect();
                writeln!(out, "<path d=\"{}\"/>", path_data(&curves, line.closed))?;
            }
            writeln!(out, "</g>")?;
        }
        Ok(())
    }

    fn write_bar(&self, out: &mut impl Write, width: f64, height: f64) -> io::Result<()> {
        let x = width - MARGIN - self.bar_width() + BEFORE_BAR;
        let title = escaped(&self.title);
        writeln!(
            out,
            "<text x=\"{x}\" y=\"{}\" font-weight=\"bold\">{title}</text>",
            MARGIN + 8.0
        )?;
        let place = Place { x, y: MARGIN + 22.0, height: height - 2.0 * MARGIN - 26.0 };
        write!(out, "{}", colour_bar(&self.values, &place))
    }

    fn bar_width(&self) -> f64 {
        BAR.max(BEFORE_BAR + LETTER * self.title.chars().count() as f64)
    }

    fn ends(&self) -> (f64, f64) {
        match self.values[..] {
            [first, .., last] => (first, last),
            _ => (0.0, 0.0),
        }
    }
}

/// From the plane of the lines to the page.
struct View {
    low: Point,
    scale: f64,
    width: f64,
    height: f64,
}

impl View {
    fn of(picture: &Picture) -> Self {
        let straight = picture.mesh.iter().chain(&picture.outline).flatten();
        let curved = picture.lines.iter().flat_map(|line| line.curves.iter().flatten());
        let points = straight.chain(curved).filter(|point| point.iter().all(|x| x.is_finite()));
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for point in points {
            for n in 0..2 {
                low[n] = low[n].min(point[n]);
                high[n] = high[n].max(point[n]);
            }
        }
        let size = [0, 1].map(|n| (high[n] - low[n]).max(0.0));
        let longest = size[0].max(size[1]);
        let scale = if longest > 0.0 { SIZE / longest } else { 1.0 };
        Self { low, scale, width: size[0] * scale, height: (size[1] * scale).max(160.0) }
    }

    fn place(&self, point: &Point) -> Point {
        let x = MARGIN + (point[0] - self.low[0]) * self.scale;
        let y = MARGIN + self.height - (point[1] - self.low[1]) * self.scale;
        [x, y]
    }
}

fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            c if c.is_control() => escaped.push(' '),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    fn written(picture: &Picture) -> String {
        let mut bytes = Vec::new();
        picture.write(&mut bytes).unwrap();
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn a_line_from_corner_to_corner() {
        let picture = Picture {
            title: "a < b".to_owned(),
            values: vec![1.0],
            outline: vec![[[0.0, 0.0], [1.0, 0.0]], [[1.0, 0.0], [1.0, 1.0]]],
            lines: vec![Coloured {
                value: 1.0,
                curves: vec![[[0.0, 0.0], [0.0, 0.5], [0.5, 1.0], [1.0, 1.0]]],
                closed: false,
            }],
            ..Picture::default()
        };
        let text = written(&picture);
        assert!(text.contains("<path d=\"M20 740c0-360 360-720 720-720\"/>"), "{text}");
        assert!(text.contains("a &lt; b"));
        assert!(text.contains("M20 740l720 0M740 740l0-720"), "{text}");
    }

    #[test]
    fn a_long_title_has_its_place() {
        let width = |title: &str| {
            let text = written(&Picture { title: title.to_owned(), ..Picture::default() });
            let start = text.find(" width=\"").unwrap() + 8;
            text[start..].split('"').next().unwrap().parse::<f64>().unwrap()
        };
        assert_eq!(width("u"), width("velocity"));
        assert!(width("DistanceToCenter") > width("u"));
        assert!(width(&"W".repeat(40)) > 40.0 * LETTER);
    }

    #[test]
    fn nothing_to_show_is_still_a_picture() {
        assert!(written(&Picture::default()).ends_with("</svg>\n"));
    }
}
