//! When a number differs from the committed one by too much.

use std::collections::BTreeMap;

use super::table::{Entry, Key, Table};

/// Part by which a number may rise.
const RISE: f64 = 0.01;

/// Part by which a number may fall and the table stay as it is. A rise that follows is hidden by as
/// much.
const FALL: f64 = 0.04;

/// Both for another compiler than the table's, whose code differs.
const OTHER_COMPILER: f64 = 0.04;

/// What a comparison found.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Findings {
    /// What must not be: lines for people.
    pub wrong: Vec<String>,
    /// Numbers that fell, and that the table may still have as they were.
    pub fallen: Vec<String>,
    /// Lines of the table that were not measured.
    pub unmeasured: usize,
}

/// Compares what was measured with the table. Of lines whose run was not made, those of `whole`
/// processors are missed.
#[must_use]
pub fn compare(table: &Table, measured: &[Entry], compiler: &str, whole: &[&str]) -> Findings {
    let mut findings = Findings::default();
    let is_same = table.compiler == compiler;
    let (rise, fall) = if is_same { (RISE, FALL) } else { (OTHER_COMPILER, f64::INFINITY) };
    let here: BTreeMap<&Key, &Entry> = measured.iter().map(|entry| (&entry.key, entry)).collect();
    let mut there = BTreeMap::new();
    for entry in &table.entries {
        if there.insert(&entry.key, entry).is_some() {
            findings.wrong.push(format!("{}: twice in the table", entry.key.name()));
        }
        if !here.contains_key(&entry.key) {
            let was_run = measured.iter().any(|other| other.key.is_beside(&entry.key));
            if was_run || whole.contains(&entry.key.cpu.as_str()) {
                findings.wrong.push(format!("{}: in the table, not measured", entry.key.name()));
            } else {
                findings.unmeasured += 1;
            }
        }
    }
    for (key, now) in here {
        let name = key.name();
        let Some(before) = there.get(key) else {
            findings.wrong.push(format!("{name}: {:.0}, not in the table", now.value));
            continue;
        };
        if before.queries != now.queries {
            let (before, now) = (before.queries, now.queries);
            findings.wrong.push(format!("{name}: {now} queries, in the table {before}"));
            continue;
        }
        let change = now.value - before.value;
        let percent = 100.0 * change / before.value;
        let line = format!("{name}: {:.0}, was {:.0} ({percent:+.1} %)", now.value, before.value);
        // A table holds whole instructions, or tenths of few.
        let unsure = now.resolution + if before.value < 1000.0 { 0.05 } else { 0.5 };
        if change > rise * before.value + unsure {
            findings.wrong.push(line);
        } else if -change > fall * before.value + unsure {
            findings.wrong.push(format!("{line}: the table is stale, and would hide a rise"));
        } else if -change > RISE * before.value + unsure {
            findings.fallen.push(line);
        }
    }
    findings
}

#[cfg(test)]
mod tests {
    use std::slice;

    use super::{Entry, Findings, Key, Table, compare};

    fn entry(question: &str, value: f64) -> Entry {
        let key = Key::new("Cortex-M4F", "3", "bracket_tree", question);
        Entry { key, queries: 512, value, resolution: 0.0 }
    }

    fn table(entries: &[Entry]) -> Table {
        let table = Table { compiler: "rustc 1".to_owned(), entries: entries.to_vec() };
        let read = Table::parse(&table.text()).expect("what was written is read");
        assert_eq!(read, table);
        read
    }

    fn now(committed: &[Entry], measured: &[Entry]) -> Findings {
        compare(&table(committed), measured, "rustc 1", &[])
    }

    #[test]
    fn a_rise_of_more_than_a_hundredth_fails_and_names_its_line() {
        let committed = [entry("closest_far", 10_000.0), entry("first_hit", 1000.0)];
        let findings =
            now(&committed, &[entry("closest_far", 10_110.0), entry("first_hit", 1000.0)]);
        assert_eq!(
            findings.wrong,
            ["Cortex-M4F 3 bracket_tree closest_far: 10110, was 10000 (+1.1 %)"]
        );
        let findings =
            now(&committed, &[entry("closest_far", 10_090.0), entry("first_hit", 1000.0)]);
        assert_eq!(findings, Findings::default());
    }

    #[test]
    fn a_rise_that_changes_the_table_too_passes() {
        let risen = [entry("closest_far", 10_110.0)];
        assert_eq!(now(&risen, &risen), Findings::default());
    }

    #[test]
    fn a_fall_is_told_and_a_deep_one_makes_the_table_stale() {
        let committed = [entry("closest_far", 10_000.0)];
        let small = now(&committed, &[entry("closest_far", 9700.0)]);
        assert_eq!((small.wrong.len(), small.fallen.len()), (0, 1));
        let deep = now(&committed, &[entry("closest_far", 9590.0)]);
        assert!(deep.wrong.len() == 1 && deep.wrong[0].contains("stale"));
    }

    #[test]
    fn a_missing_an_extra_and_a_double_line_fail() {
        let [far, near] = [entry("closest_far", 10_000.0), entry("closest_near", 8000.0)];
        let missing = now(&[far.clone(), near.clone()], slice::from_ref(&far));
        assert_eq!(
            missing.wrong,
            ["Cortex-M4F 3 bracket_tree closest_near: in the table, not measured"]
        );
        let extra = now(slice::from_ref(&far), &[far.clone(), near]);
        assert_eq!(extra.wrong, ["Cortex-M4F 3 bracket_tree closest_near: 8000, not in the table"]);
        let double = now(&[far.clone(), far.clone()], &[far]);
        assert!(double.wrong.len() == 1 && double.wrong[0].contains("twice"));
    }

    #[test]
    fn a_run_that_was_not_made_is_missed_on_whole_processors_only() {
        let [far, near] = [entry("closest_far", 10_000.0), entry("closest_near", 8000.0)];
        let mut other = near;
        other.key.subject = "torus_tree".to_owned();
        let committed = table(&[far.clone(), other]);
        let partly = compare(&committed, slice::from_ref(&far), "rustc 1", &["RV32IMAC"]);
        assert_eq!((partly.wrong.len(), partly.unmeasured), (0, 1));
        let whole = compare(&committed, &[far], "rustc 1", &["Cortex-M4F"]);
        assert_eq!((whole.wrong.len(), whole.unmeasured), (1, 0));
    }

    #[test]
    fn means_of_different_queries_are_not_compared() {
        let committed = [entry("closest_far", 10_000.0)];
        let fewer = [Entry { queries: 128, ..entry("closest_far", 10_000.0) }];
        assert!(now(&committed, &fewer).wrong[0].contains("128 queries, in the table 512"));
    }

    #[test]
    fn another_compiler_may_differ_by_more() {
        let committed = table(&[entry("closest_far", 10_000.0)]);
        let with_other =
            |value: f64| compare(&committed, &[entry("closest_far", value)], "rustc 2", &[]);
        assert!(with_other(10_390.0).wrong.is_empty() && with_other(8000.0).wrong.is_empty());
        assert_eq!(with_other(10_410.0).wrong.len(), 1);
    }

    #[test]
    fn a_rise_below_the_counter_s_resolution_is_none() {
        let committed = [entry("tribox_overlap", 100.0)];
        let coarse = |value: f64| [Entry { resolution: 4.0, ..entry("tribox_overlap", value) }];
        assert!(now(&committed, &coarse(104.5)).wrong.is_empty());
        assert_eq!(now(&committed, &coarse(105.5)).wrong.len(), 1);
    }
}
