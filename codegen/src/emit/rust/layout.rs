//! The layout of formatted code. The formatter breaks a line early, and gives each item of a list that it breaks its own line:
//! a hundred names a hundred lines. Here what fits goes on one line, and short items are set as a paragraph.

/// Columns of a line.
const WIDTH: usize = 100;

/// The code on fewer lines: the same tokens, but for commas at the end of lists.
pub(super) fn laid_out(code: &str) -> String {
    let mut text = filled(&joined(code));
    text.push('\n');
    text
}

fn indent(line: &str) -> usize {
    line.len() - line.trim_start().len()
}

fn width(line: &str) -> usize {
    line.chars().count()
}

/// Calls, lists and operators that fit on one line.
fn joined(code: &str) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    // The lines that end with a bracket which is still open.
    let mut open: Vec<usize> = Vec::new();
    for line in code.lines() {
        let item = line.trim_start();
        if item.starts_with("//") || item.starts_with('#') {
            lines.push(line.to_owned());
            continue;
        }
        if item.starts_with([')', ']'])
            && let Some(first) = open.pop()
        {
            close(&mut lines, first, line);
        } else if let Some(longer) = continued(lines.last(), item) {
            lines.pop();
            lines.push(longer);
        } else {
            lines.push(line.to_owned());
        }
        if lines.last().is_some_and(|line| line.ends_with(['(', '['])) {
            open.push(lines.len() - 1);
        }
    }
    lines
}

/// The last line and a method's call, or an operator, that goes on with it, if both fit on one.
fn continued(last: Option<&String>, item: &str) -> Option<String> {
    let last = last?;
    let separator = if item.starts_with('.') {
        ""
    } else if ["+ ", "- ", "* ", "/ "]
        .iter()
        .any(|op| item.starts_with(op))
    {
        " "
    } else {
        return None;
    };
    let is_over = last.trim_start().starts_with("//") || last.ends_with([',', ';', '{', '(', '[']);
    let longer = format!("{last}{separator}{item}");
    (!is_over && width(&longer) <= WIDTH).then_some(longer)
}

/// Ends the list that the line at `first` opens: on one line if it fits there, or else indented as that line is.
fn close(lines: &mut Vec<String>, first: usize, line: &str) {
    let items: Vec<&str> = lines[first + 1..].iter().map(|line| line.trim()).collect();
    let items = items.join(" ");
    let one = format!(
        "{}{}{}",
        lines[first],
        items.strip_suffix(',').unwrap_or(&items),
        line.trim_start()
    );
    // No comment, and nothing left open within.
    let is_whole = !items.contains("//") && !items.is_empty() && balanced(&one);
    if is_whole && width(&one) <= WIDTH {
        lines.truncate(first);
        lines.push(one);
        return;
    }
    let farther = indent(line).saturating_sub(indent(&lines[first]));
    for inner in &mut lines[first + 1..] {
        let by = farther.min(indent(inner));
        inner.drain(..by);
    }
    lines.push(line[farther..].to_owned());
}

/// Whether every bracket that the line closes is one that it opens.
fn balanced(line: &str) -> bool {
    let count = |bracket: char| line.matches(bracket).count();
    count('[') >= count(']') && count('(') >= count(')')
}

/// Names, numbers and the like, of which there are several in a list, on as few lines as they fit.
fn filled(lines: &[String]) -> String {
    let mut text = String::new();
    // Of the last line, how far it is indented, if another item may follow on it, and how long it is.
    let mut open: Option<(usize, usize)> = None;
    for line in lines {
        let item = line.trim_start();
        let (own, short) = (indent(line), is_short(item));
        match open {
            Some((other, length)) if short && other == own && length + 1 + item.len() <= WIDTH => {
                text.push(' ');
                text.push_str(item);
                open = Some((own, length + 1 + item.len()));
            }
            _ => {
                if !text.is_empty() {
                    text.push('\n');
                }
                text.push_str(line);
                open = short.then_some((own, line.len()));
            }
        }
    }
    text
}

/// Whether a line is an item of a list and nothing else: a pair of numbers, a text, or without a space, an operator or an open bracket.
fn is_short(item: &str) -> bool {
    let Some(item) = item.strip_suffix(',') else {
        return false;
    };
    let pair = item
        .strip_prefix('(')
        .and_then(|item| item.strip_suffix(')'));
    let pair = pair.and_then(|item| item.split_once(", "));
    let is_number = |text: &str| text.chars().all(|c| c.is_ascii_digit());
    let text = item
        .strip_prefix('"')
        .and_then(|item| item.strip_suffix('"'));
    if pair.is_some_and(|(a, b)| is_number(a) && is_number(b))
        || text.is_some_and(|text| !text.contains(['"', '\\']))
    {
        return true;
    }
    let plain = |c: char| c.is_ascii_alphanumeric() || "_.[]():-".contains(c);
    let count = |bracket: char| item.matches(bracket).count();
    !item.is_empty()
        && item.chars().all(plain)
        && count('[') == count(']')
        && count('(') == count(')')
}

#[cfg(test)]
mod tests {
    use ulna_table::Model;

    use super::*;

    #[test]
    fn what_fits_is_one_line_and_short_items_are_a_paragraph() {
        let code = "let (\n    a,\n    b,\n);\nlet t1 = s1\n    .mul_add(\n        R::of(1.0),\n        s2 * t2,\n    ) - t3;\n";
        assert_eq!(
            laid_out(code),
            "let (a, b);\nlet t1 = s1.mul_add(R::of(1.0), s2 * t2) - t3;\n"
        );
        let many = format!("[\n{}]\n", "    abcdefgh,\n".repeat(30));
        assert!(laid_out(&many).lines().all(|line| line.len() <= WIDTH));
        assert_eq!(laid_out(&many).matches("abcdefgh").count(), 30);
        let long = "t1".repeat(30);
        let code = format!("let x = a\n    .mul_add(\n        {long},\n        {long},\n    );\n");
        assert_eq!(
            laid_out(&code),
            format!("let x = a.mul_add(\n    {long},\n    {long},\n);\n")
        );
    }

    /// The formatter makes the same of it as of what it was made of.
    #[test]
    fn the_code_stays_the_same() {
        for arm in ["planar_2r", "oblique_6"] {
            let model = Model::load(format!("../arms/{arm}.toml")).unwrap();
            let file = syn::parse2(crate::generate(&model, "x").tokens().clone()).unwrap();
            let formatted = prettyplease::unparse(&file);
            let again = syn::parse_file(&laid_out(&formatted)).unwrap();
            assert_eq!(prettyplease::unparse(&again), formatted, "{arm}");
        }
    }
}
