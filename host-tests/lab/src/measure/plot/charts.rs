//! Which tables are trades, and what their columns mean.

use meshsweep_xtask::table::Table;

/// One panel.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// The mesh and what is shown.
    pub title: String,
    /// What is paid, with its unit; on a logarithmic axis.
    pub x: &'static str,
    /// What is had, with its unit.
    pub y: &'static str,
    /// Whether that is on a logarithmic axis too, on which zeros are drawn at the bottom, hollow.
    pub is_log: bool,
    /// Whether the points of a series are one line.
    pub is_line: bool,
    /// What the series are.
    pub legend: &'static str,
    /// Points of each colour.
    pub series: Vec<Series>,
}

/// Points of one colour.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// In the legend.
    pub name: String,
    /// In the table's order.
    pub points: Vec<Point>,
}

/// A point and its label.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// What is paid, above zero.
    pub x: f64,
    /// What is had, not below zero.
    pub y: f64,
    /// Beside it.
    pub label: String,
}

/// How rows make series.
enum Split {
    /// A column has the series' names, another the values.
    Names(&'static str, &'static str),
    /// Each series has a column of its own: its name, and the column.
    Columns(&'static [(&'static str, &'static str)]),
}

/// How a table is shown.
struct View {
    table: &'static str,
    title: &'static str,
    /// Axis, and column.
    x: [&'static str; 2],
    /// Axis.
    y: &'static str,
    is_log: bool,
    is_line: bool,
    legend: &'static str,
    split: Split,
    /// Column of the labels, and what follows them.
    label: [&'static str; 2],
}

const INSTRUCTIONS: &str = "bounds_instructions";

const fn bounds(table: &'static str, x: [&'static str; 2], is_volume: bool) -> View {
    let (title, y, column) = if is_volume {
        (
            "volume of bounds against their cost",
            "volume over the convex hull's (log)",
            "volume, of the hull's",
        )
    } else {
        (
            "false positives of bounds against their cost",
            "pairs reported that do not meet, %",
            "false %",
        )
    };
    let split = Split::Names("bounded about", column);
    View {
        table,
        title,
        x,
        y,
        is_log: is_volume,
        is_line: false,
        legend: "bounded anew about:",
        split,
        label: ["bound", ""],
    }
}

const fn closest(
    table: &'static str,
    title: &'static str,
    error: &'static str,
    label: [&'static str; 2],
) -> View {
    View {
        table,
        title,
        x: ["time of a query, ns (log)", "ns"],
        y: "mean error of the distance, relative (log)",
        is_log: true,
        is_line: true,
        legend: "points:",
        split: Split::Names("points", error),
        label,
    }
}

const TIME: [&str; 2] = ["to move it and test it once, ns (log)", "both ns"];
const WORK: [&str; 2] = ["to move it and test it once, instructions (log)", "both instructions"];

/// In the order of the panels.
const VIEWS: [View; 10] = [
    bounds(INSTRUCTIONS, WORK, false),
    bounds(INSTRUCTIONS, WORK, true),
    bounds("bounds_time", TIME, false),
    bounds("bounds_time", TIME, true),
    closest(
        "tolerance",
        "hull hierarchy, closest point within a tolerance",
        "mean error",
        ["tolerance", ""],
    ),
    closest(
        "steps",
        "hull hierarchy, closest point after so many nodes",
        "mean error",
        ["steps", ""],
    ),
    View {
        table: "cuts",
        title: "hull hierarchy, closest point on blobs cut after a level",
        x: ["blob, bytes (log)", "bytes"],
        y: "mean width of the interval, of the diagonal (log)",
        is_log: true,
        is_line: true,
        legend: "points:",
        split: Split::Columns(&[("far", "far of diagonal"), ("near", "near of diagonal")]),
        label: ["level", ""],
    },
    closest(
        "tree_tolerance",
        "box tree, closest point within a tolerance",
        "found",
        ["tolerance %", " %"],
    ),
    closest("tree_steps", "box tree, closest point after so many nodes", "found", ["steps", ""]),
    View {
        table: "tight_trade",
        title: "void of hulls and other bounds",
        x: ["faces (log)", "faces"],
        y: "void, % of the mesh's volume (log)",
        is_log: true,
        is_line: true,
        legend: "",
        split: Split::Names("bound", "void %"),
        label: ["label", ""],
    },
];

/// The charts of a mesh's tables. Where instructions were counted, times are left out: those are
/// noise.
///
/// # Errors
/// A table lacks a column that its chart needs.
pub fn of(mesh: &str, tables: &[Table]) -> Result<Vec<Chart>, String> {
    let is_counted = tables.iter().any(|table| table.key == INSTRUCTIONS);
    let shown = VIEWS.iter().filter(|view| !(is_counted && view.table == "bounds_time"));
    let found =
        shown.filter_map(|view| Some((view, tables.iter().find(|table| table.key == view.table)?)));
    let mut charts = Vec::new();
    for (view, table) in found {
        let series = view.series(table)?;
        let title = format!("{mesh}: {}", view.title);
        let View { x: [x, _], y, is_log, is_line, legend, .. } = *view;
        if !series.is_empty() {
            charts.push(Chart { title, x, y, is_log, is_line, legend, series });
        }
    }
    Ok(charts)
}

impl View {
    /// Rows in which a number is missing are no points; nor is what costs nothing, which no
    /// logarithmic axis has.
    fn series(&self, table: &Table) -> Result<Vec<Series>, String> {
        let column = |name: &str| {
            let at = table.columns.iter().position(|column| *column == name);
            at.ok_or_else(|| format!("table {} has no column `{name}`", table.key))
        };
        let (x, label) = (column(self.x[1])?, column(self.label[0])?);
        // Where a series' name is, or what it is, and where its values are.
        let split: Vec<(Result<usize, &str>, usize)> = match &self.split {
            Split::Names(by, y) => vec![(Ok(column(by)?), column(y)?)],
            Split::Columns(columns) => {
                let each = columns.iter().map(|(name, y)| Ok((Err(*name), column(y)?)));
                each.collect::<Result<_, String>>()?
            }
        };
        let mut all: Vec<Series> = Vec::new();
        for row in &table.rows {
            for (name, y) in &split {
                let name = name.map_or_else(str::to_owned, |at| row[at].text());
                let (Some(x), Some(y)) = (row[x].number(), row[*y].number()) else { continue };
                if !(x > 0.0 && y >= 0.0 && x.is_finite() && y.is_finite()) {
                    continue;
                }
                let point = Point { x, y, label: row[label].text() + self.label[1] };
                match all.iter_mut().find(|series| series.name == name) {
                    Some(series) => series.points.push(point),
                    None => all.push(Series { name, points: vec![point] }),
                }
            }
        }
        Ok(all)
    }
}

#[cfg(test)]
mod tests {
    use super::{Point, of};
    use meshsweep_xtask::table::{Cell, Table, fixed, row, scientific};

    fn steps() -> Table {
        let mut table = Table::new("tree_steps", "Steps", &["points", "steps", "ns", "found"]);
        table.push(row!["far", 1u32, fixed(100.0, 0), scientific(0.5)]);
        table.push(row!["near", 1u32, fixed(80.0, 0), scientific(0.25)]);
        table.push(row!["far", 2u32, fixed(150.0, 0), scientific(0.0)]);
        table.push(row!["far", 4u32, fixed(0.0, 0), scientific(0.1)]);
        table.push(row!["far", 8u32, fixed(200.0, 0), Cell::Empty]);
        table.push(row!["far", 16u32, fixed(200.0, 0), scientific(f64::NAN)]);
        table
    }

    #[test]
    fn rows_with_numbers_are_points_of_the_series_that_they_name() {
        let other = Table::new("sections", "Sections", &["section", "bytes"]);
        let charts = of("torus", &[other.clone(), steps()]).expect("all columns");
        let [chart] = &charts[..] else { panic!("{charts:?}") };
        assert_eq!(chart.title, "torus: box tree, closest point after so many nodes");
        let point = |x, y, label: &str| Point { x, y, label: label.to_owned() };
        let series: Vec<_> =
            chart.series.iter().map(|s| (s.name.as_str(), s.points.clone())).collect();
        let far = vec![point(100.0, 0.5, "1"), point(150.0, 0.0, "2")];
        assert_eq!(series, [("far", far), ("near", vec![point(80.0, 0.25, "1")])]);
        assert_eq!(of("torus", &[other]), Ok(Vec::new()));
    }

    #[test]
    fn a_table_without_the_column_is_refused() {
        let table = Table::new("tree_steps", "Steps", &["points", "steps", "ns"]);
        assert_eq!(of("torus", &[table]), Err("table tree_steps has no column `found`".to_owned()));
    }
}
