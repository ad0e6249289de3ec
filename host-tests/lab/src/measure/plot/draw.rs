//! Panels as SVG.

use plotters::coord::Shift;
use plotters::coord::combinators::BindKeyPoints;
use plotters::coord::ranged1d::{AsRangedCoord, Ranged, ValueFormatter};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::charts::{Chart, Series};
use super::labels::{Rect, place};

/// Panels beside each other.
const COLUMNS: usize = 2;
/// Pixels of a panel.
const PANEL: [u32; 2] = [760, 520];
const MARKER: i32 = 4;
const LABEL: f64 = 12.0;
/// Pixels from which a label is led to its point by a line.
const LEADER: f64 = 14.0;
/// Width of a letter on average, of its height, in the widest of the usual fonts.
const LETTER: f64 = 0.6;

/// Apart for the colour-blind too (Okabe & Ito 2008).
const COLOURS: [RGBColor; 4] =
    [RGBColor(0, 114, 178), RGBColor(213, 94, 0), RGBColor(0, 130, 100), RGBColor(150, 80, 140)];

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// All charts, those of a row beside each other.
pub fn svg(rows: &[Vec<Chart>]) -> Result<String, String> {
    let lines: Vec<&[Chart]> = rows.iter().flat_map(|row| row.chunks(COLUMNS)).collect();
    let columns = lines.iter().map(|line| line.len()).max().unwrap_or(1);
    let mut text = String::new();
    {
        let size = (PANEL[0] * columns as u32, PANEL[1] * lines.len() as u32);
        let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
        root.fill(&WHITE).map_err(|error| error.to_string())?;
        for (panels, line) in root.split_evenly((lines.len(), columns)).chunks(columns).zip(&lines)
        {
            for (panel, chart) in panels.iter().zip(*line) {
                self::panel(panel, chart).map_err(|error| format!("{}: {error}", chart.title))?;
            }
        }
        root.present().map_err(|error| error.to_string())?;
    }
    Ok(text)
}

type Failed = Box<dyn std::error::Error>;

fn panel(panel: &Area<'_>, chart: &Chart) -> Result<(), Failed> {
    panel.draw(&Text::new(chart.title.clone(), (76, 14), ("sans-serif", 17).into_font()))?;
    legend(panel, chart)?;
    let (_, area) = panel.split_vertically(64);
    let points = || chart.series.iter().flat_map(|series| &series.points);
    let x = wide(points().map(|p| p.x), 1.8);
    if chart.is_log {
        let mut y = wide(points().map(|p| p.y).filter(|y| *y > 0.0), 1.6);
        if points().any(|p| is_zero(chart, p.y)) {
            // Apart from the least that is none.
            y.start /= 2.0;
        }
        plot(&area, chart, x, (y.start..y.end).log_scale().with_key_points(ticks(&y)), y.start)
    } else {
        let most = points().map(|p| p.y).fold(0.0, f64::max);
        plot(&area, chart, x, 0.0..(if most > 0.0 { 1.12 * most } else { 1.0 }), 0.0)
    }
}

/// A range on a logarithmic axis with `margin` times as much on either side.
fn wide(values: impl Iterator<Item = f64>, margin: f64) -> std::ops::Range<f64> {
    let (low, high) =
        values.fold((f64::INFINITY, 0.0f64), |(low, high), x| (low.min(x), high.max(x)));
    if low < f64::INFINITY { low / margin..high * margin } else { 0.1..1.0 }
}

fn legend(panel: &Area<'_>, chart: &Chart) -> Result<(), Failed> {
    let mut left = 80;
    let plain = || {
        ("sans-serif", LABEL + 1.0)
            .into_font()
            .color(&BLACK.mix(0.7))
            .pos(Pos::new(HPos::Left, VPos::Center))
    };
    if !chart.legend.is_empty() {
        panel.draw(&Text::new(chart.legend, (left - 4, 48), plain()))?;
        left += 14 + wide_text(chart.legend);
    }
    for (index, series) in chart.series.iter().enumerate() {
        marker(panel, index, (left, 48), false)?;
        let style = ("sans-serif", LABEL + 1.0)
            .into_font()
            .color(&colour(index))
            .pos(Pos::new(HPos::Left, VPos::Center));
        panel.draw(&Text::new(series.name.clone(), (left + 10, 48), style))?;
        left += 28 + wide_text(&series.name);
    }
    if chart.series.iter().flat_map(|series| &series.points).any(|p| is_zero(chart, p.y)) {
        panel.draw(&Text::new("hollow: zero", (left, 48), plain()))?;
    }
    Ok(())
}

/// Pixels of a text in the legend.
fn wide_text(text: &str) -> i32 {
    (text.chars().count() as f64 * LETTER * (LABEL + 1.0)) as i32
}

fn is_zero(chart: &Chart, y: f64) -> bool {
    chart.is_log && y <= 0.0
}

fn colour(index: usize) -> RGBColor {
    COLOURS[index % COLOURS.len()]
}

/// Another shape for each series, for those who print in black.
fn marker(
    panel: &Area<'_>,
    index: usize,
    (x, y): (i32, i32),
    is_hollow: bool,
) -> Result<(), Failed> {
    let style = if is_hollow { colour(index).stroke_width(1) } else { colour(index).filled() };
    let r = MARKER;
    match index % 3 {
        0 => panel.draw(&Circle::new((x, y), r, style))?,
        1 => panel.draw(&Rectangle::new([(x - r, y - r), (x + r, y + r)], style))?,
        _ => {
            let corners = vec![(x, y - r - 1), (x + r + 1, y + r), (x - r - 1, y + r)];
            if is_hollow {
                let closed = corners.iter().chain(corners.first()).copied().collect::<Vec<_>>();
                panel.draw(&PathElement::new(closed, style))?;
            } else {
                panel.draw(&Polygon::new(corners, style))?;
            }
        }
    }
    Ok(())
}

fn plot<Y>(
    area: &Area<'_>,
    chart: &Chart,
    x: std::ops::Range<f64>,
    y: impl AsRangedCoord<CoordDescType = Y, Value = f64>,
    floor: f64,
) -> Result<(), Failed>
where
    Y: Ranged<ValueType = f64> + ValueFormatter<f64>,
{
    let mut context = ChartBuilder::on(area)
        .margin_right(16)
        .margin_bottom(6)
        .margin_left(12)
        .x_label_area_size(48)
        .y_label_area_size(64)
        .build_cartesian_2d((x.start..x.end).log_scale().with_key_points(ticks(&x)), y)?;
    context
        .configure_mesh()
        .x_desc(chart.x)
        .y_desc(chart.y)
        .axis_desc_style(("sans-serif", 14))
        .label_style(("sans-serif", 12))
        .x_label_formatter(&|x| tick(*x))
        .y_label_formatter(&|y| tick(*y))
        .max_light_lines(1)
        .light_line_style(BLACK.mix(0.05))
        .bold_line_style(BLACK.mix(0.12))
        .draw()?;
    let plotting = context.plotting_area();
    // To the pixels of the area, which begins somewhere in the figure.
    let (offset_x, offset_y) = area.get_base_pixel();
    let pixel = |x: f64, y: f64| {
        let (px, py) = plotting.map_coordinate(&(x, y.max(floor)));
        (px - offset_x, py - offset_y)
    };
    let (across, down) = plotting.get_pixel_range();
    let frame = Rect {
        low: [across.start - offset_x, down.start - offset_y].map(f64::from),
        high: [across.end - offset_x, down.end - offset_y].map(f64::from),
    };
    let spots: Vec<Vec<(i32, i32)>> = chart
        .series
        .iter()
        .map(|series| series.points.iter().map(|p| pixel(p.x, p.y)).collect())
        .collect();
    if chart.is_line {
        for (index, line) in spots.iter().enumerate() {
            area.draw(&PathElement::new(line.clone(), colour(index).mix(0.5)))?;
        }
    }
    named(area, chart, &frame, &spots)?;
    for (index, (series, spots)) in chart.series.iter().zip(&spots).enumerate() {
        for (point, &spot) in series.points.iter().zip(spots) {
            marker(area, index, spot, is_zero(chart, point.y))?;
        }
    }
    Ok(())
}

/// The labels, with lines to those that found no room beside their points.
fn named(
    area: &Area<'_>,
    chart: &Chart,
    frame: &Rect,
    spots: &[Vec<(i32, i32)>],
) -> Result<(), Failed> {
    let exact = |&(x, y): &(i32, i32)| [f64::from(x), f64::from(y)];
    let points: Vec<[f64; 2]> = spots.iter().flatten().map(exact).collect();
    let labels: Vec<(usize, &str)> = chart
        .series
        .iter()
        .enumerate()
        .flat_map(|(index, Series { points, .. })| {
            points.iter().map(move |p| (index, p.label.as_str()))
        })
        .collect();
    let sizes: Vec<[f64; 2]> = labels
        .iter()
        .map(|(_, text)| [text.chars().count() as f64 * LETTER * LABEL, LABEL])
        .collect();
    let lines: Vec<[[f64; 2]; 2]> = if chart.is_line {
        spots
            .iter()
            .flat_map(|line| line.windows(2).map(|pair| [exact(&pair[0]), exact(&pair[1])]))
            .collect()
    } else {
        Vec::new()
    };
    let places = place(frame, &points, &sizes, f64::from(MARKER) + 1.0, &lines);
    for (((index, text), rect), point) in labels.into_iter().zip(&places).zip(&points) {
        let whole = |p: [f64; 2]| (p[0].round() as i32, p[1].round() as i32);
        if rect.distance(*point) > LEADER {
            let leader = vec![whole(*point), whole(rect.nearest(*point))];
            area.draw(&PathElement::new(leader, colour(index).mix(0.5)))?;
        }
        // Next to its point even if the font is narrower than allowed for.
        let (side, x) = if rect.low[0] >= point[0] {
            (HPos::Left, rect.low[0])
        } else if rect.high[0] <= point[0] {
            (HPos::Right, rect.high[0])
        } else {
            (HPos::Center, 0.5 * (rect.low[0] + rect.high[0]))
        };
        let style = ("sans-serif", LABEL)
            .into_font()
            .color(&colour(index))
            .pos(Pos::new(side, VPos::Center));
        area.draw(&Text::new(
            text.to_owned(),
            whole([x, 0.5 * (rect.low[1] + rect.high[1])]),
            style,
        ))?;
    }
    Ok(())
}

/// Numbers on a logarithmic axis: decades, or so many of each that there are some, but never so
/// many that they touch.
fn ticks(range: &std::ops::Range<f64>) -> Vec<f64> {
    let [first, last] = [range.start, range.end].map(|x| x.log10().floor() as i32);
    let of = |digits: &[f64], every: i32| -> Vec<f64> {
        let decades = (first..=last).filter(|decade| decade % every == 0);
        // Divided, for powers below one are not exact.
        let scaled = |digit: f64, decade: i32| {
            if decade < 0 { digit / 10f64.powi(-decade) } else { digit * 10f64.powi(decade) }
        };
        let all = decades.flat_map(|decade| digits.iter().map(move |digit| scaled(*digit, decade)));
        all.filter(|x| range.contains(x)).collect()
    };
    match last - first {
        0 => of(&[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0], 1),
        1 | 2 => of(&[1.0, 2.0, 5.0], 1),
        decades => of(&[1.0], (decades + 7) / 8),
    }
}

/// A number on an axis: as short as it can be.
fn tick(value: f64) -> String {
    if value == 0.0 || (0.01..1_000.0).contains(&value) {
        let text = format!("{value:.2}");
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else if (1_000.0..1_000_000.0).contains(&value) {
        format!("{},{:03}", value as u64 / 1_000, value as u64 % 1_000)
    } else if value == 1e6 {
        "1,000,000".to_owned()
    } else {
        format!("{value:.0e}")
    }
}

#[cfg(test)]
mod tests {
    use super::{tick, ticks};

    #[test]
    fn ticks_are_some_and_round_and_written_short() {
        assert_eq!(ticks(&(3.0..400.0)), [5.0, 10.0, 20.0, 50.0, 100.0, 200.0]);
        assert_eq!(ticks(&(0.0005..2.0)), [0.001, 0.01, 0.1, 1.0]);
        assert_eq!(ticks(&(2.5..4.5)), [3.0, 4.0]);
        for exponents in [(-9.0, 3.0), (0.3, 7.9), (-2.2, -1.9), (2.9, 3.1), (4.0, 5.0)] {
            let range = 10f64.powf(exponents.0)..10f64.powf(exponents.1);
            assert!((1..=9).contains(&ticks(&range).len()), "{range:?}");
        }
        assert_eq!(
            [0.0, 0.05, 1.5, 20.0, 5_000.0, 1e6, 1e7, 1e-9].map(tick),
            ["0", "0.05", "1.5", "20", "5,000", "1,000,000", "1e7", "1e-9"]
        );
    }
}
