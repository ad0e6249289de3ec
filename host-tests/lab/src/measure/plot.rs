//! Tables that are a trade as a plot: loss against cost, a panel each, mesh below mesh.

use meshsweep_xtask::table::Table;
use plotters::coord::Shift;
use plotters::prelude::*;

/// What was measured on a mesh.
pub struct Measured {
    /// The mesh's name.
    pub mesh: String,
    /// Its tables.
    pub tables: Vec<Table>,
}

/// How a table is shown. Both axes are logarithmic.
struct View {
    table: &'static str,
    title: &'static str,
    /// Column of the series' names.
    series: &'static str,
    /// Axis, and column.
    x: [&'static str; 2],
    /// Axis, and column.
    y: [&'static str; 2],
}

const INSTRUCTIONS: [&str; 2] = ["to move it and test it once, instructions", "both"];

const VIEWS: [View; 4] = [
    View {
        table: "bounds_instructions",
        title: "false positives of bounds, about their own vertices and the hull's",
        series: "bound",
        x: INSTRUCTIONS,
        y: ["pairs reported that do not meet, %", "false %"],
    },
    View {
        table: "bounds_instructions",
        title: "volume of bounds, about their own vertices and the hull's",
        series: "bound",
        x: INSTRUCTIONS,
        y: ["volume over the convex hull's", "volume, of the hull's"],
    },
    View {
        table: "tight_trade",
        title: "void of hulls and other bounds",
        series: "bound",
        x: ["faces", "faces"],
        y: ["void, % of the mesh's volume", "void %"],
    },
    View {
        table: "hausdorff_samples",
        title: "samples of a simplified mesh by their distances",
        series: "mesh",
        x: ["distance, % of the diagonal", "distance, %"],
        y: ["samples that are farther, %", "samples that are farther, %"],
    },
];

/// A name and its points.
type Series = (String, Vec<(f64, f64)>);

/// A table's series. A row is no point if it lacks a number, or if a number is not above zero.
fn series(view: &View, table: &Table) -> Result<Vec<Series>, String> {
    let column = |name: &str| {
        let at = table.columns.iter().position(|column| *column == name);
        at.ok_or_else(|| format!("table {} has no column `{name}`", table.key))
    };
    let (name, x, y) = (column(view.series)?, column(view.x[1])?, column(view.y[1])?);
    let mut all: Vec<Series> = Vec::new();
    for row in &table.rows {
        let number = |at: usize| row[at].number().filter(|&x| x > 0.0 && x.is_finite());
        let (Some(x), Some(y)) = (number(x), number(y)) else { continue };
        let name = row[name].text();
        match all.iter_mut().find(|(found, _)| *found == name) {
            Some((_, points)) => points.push((x, y)),
            None => all.push((name, vec![(x, y)])),
        }
    }
    Ok(all)
}

/// An SVG with a panel for every trade among the tables.
///
/// # Errors
/// No table is one, one lacks a column, or plotters refuses.
pub fn svg(measured: &[Measured]) -> Result<String, String> {
    let mut panels = Vec::new();
    for Measured { mesh, tables } in measured {
        for view in &VIEWS {
            for table in tables.iter().filter(|table| table.key == view.table) {
                panels.push((format!("{mesh}: {}", view.title), view, series(view, table)?));
            }
        }
    }
    panels.retain(|(_, _, series)| !series.is_empty());
    if panels.is_empty() {
        return Err("none of the tables is a trade that can be plotted".to_owned());
    }
    let mut text = String::new();
    {
        let size = (900, 560 * panels.len() as u32);
        let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
        root.fill(&WHITE).map_err(|error| error.to_string())?;
        for (area, (title, view, series)) in
            root.split_evenly((panels.len(), 1)).iter().zip(&panels)
        {
            draw(area, title, view, series).map_err(|error| format!("{title}: {error}"))?;
        }
        root.present().map_err(|error| error.to_string())?;
    }
    Ok(text)
}

fn draw(
    area: &DrawingArea<SVGBackend<'_>, Shift>,
    title: &str,
    view: &View,
    series: &[Series],
) -> Result<(), Box<dyn std::error::Error>> {
    let points = || series.iter().flat_map(|(_, points)| points);
    let range = |of: fn(&(f64, f64)) -> f64| {
        let (low, high) =
            points().map(of).fold((f64::INFINITY, 0.0), |(low, high), x| (x.min(low), x.max(high)));
        (low / 1.5..high * 1.5).log_scale()
    };
    let mut chart = ChartBuilder::on(area)
        .caption(title, ("sans-serif", 18))
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(64)
        .build_cartesian_2d(range(|point| point.0), range(|point| point.1))?;
    chart.configure_mesh().x_desc(view.x[0]).y_desc(view.y[0]).draw()?;
    for (index, (name, points)) in series.iter().enumerate() {
        let colour = Palette99::pick(index).to_rgba();
        let line = LineSeries::new(points.iter().copied(), colour.mix(0.5)).point_size(4);
        chart
            .draw_series(line)?
            .label(name)
            .legend(move |(x, y)| Circle::new((x + 10, y), 4, colour.filled()));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .background_style(WHITE.mix(0.8))
        .border_style(BLACK.mix(0.3))
        .draw()?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{VIEWS, series};
    use meshsweep_xtask::table::{Cell, Table, fixed, row};

    #[test]
    fn rows_with_numbers_are_points_of_the_series_that_they_name() {
        let mut table = Table::new("tight_trade", "Void", &["bound", "faces", "void %"]);
        table.push(row!["tight", 20u32, fixed(50.0, 0)]);
        table.push(row!["convex", 6u32, fixed(80.0, 0)]);
        table.push(row!["tight", 50u32, fixed(20.0, 0)]);
        table.push(row!["tight", 100u32, fixed(0.0, 0)]);
        table.push(row!["tight", 200u32, Cell::Empty]);
        let expected = [
            ("tight".to_owned(), vec![(20.0, 50.0), (50.0, 20.0)]),
            ("convex".to_owned(), vec![(6.0, 80.0)]),
        ];
        assert_eq!(series(&VIEWS[2], &table), Ok(expected.to_vec()));
        let other = Table::new("tight_trade", "Void", &["bound", "faces"]);
        let missing = "table tight_trade has no column `void %`".to_owned();
        assert_eq!(series(&VIEWS[2], &other), Err(missing));
    }
}
