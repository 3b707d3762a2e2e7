//! Lines of C: no longer than they can be read, and comments that end where they should.

/// Columns of a line.
const WIDTH: usize = 100;

/// A statement, indented, on as many lines as it takes: it is broken before an operator.
pub(super) fn statement(text: &str) -> String {
    let (mut lines, mut rest, mut indent) = (String::new(), text, 4);
    while let Some(place) = break_of(rest, WIDTH - indent) {
        let (line, next) = rest.split_at(place);
        lines.push_str(&format!("{:indent$}{}\n", "", line.trim_end()));
        (rest, indent) = (next.trim_start(), 8);
    }
    lines + &format!("{:indent$}{rest}\n", "")
}

/// Where a text of more than `width` columns is broken.
fn break_of(text: &str, width: usize) -> Option<usize> {
    if text.len() <= width {
        return None;
    }
    let operator = |place: &usize| {
        [" + ", " - ", " * ", " / ", " = "]
            .iter()
            .any(|operator| text[*place..].starts_with(operator))
    };
    let places = || text.match_indices(' ').map(|(place, _)| place);
    let fits = places()
        .filter(operator)
        .take_while(|place| *place <= width);
    // Rather at a sum than within a product.
    let at_sum = fits
        .clone()
        .filter(|place| text[*place..].starts_with(" + ") || text[*place..].starts_with(" - "));
    let far = at_sum.last().filter(|place| *place > width / 2);
    far.or_else(|| fits.last()).filter(|place| *place > 0)
}

/// A comment of several lines; nothing if there are none.
pub(super) fn comment(lines: &[String]) -> String {
    if lines.is_empty() {
        return String::new();
    }
    let lines = lines.iter().map(|line| match harmless(line).trim_end() {
        "" => " *\n".to_owned(),
        line => format!(" * {line}\n"),
    });
    format!("/*\n{} */\n", lines.collect::<String>())
}

/// A line without what would end, or seem to begin, a comment.
fn harmless(line: &str) -> String {
    line.replace("*/", "* /")
        .replace("//", "/ /")
        .replace("/*", "/ *")
}

/// Paragraphs as lines that are no longer than they can be read: what stands on lines one after another is one of them. What follows
/// the first line of one is indented by `hanging` more columns.
pub(super) fn paragraphs(lines: &[String], hanging: usize) -> Vec<String> {
    let mut wrapped = Vec::new();
    for paragraph in lines.split(String::is_empty) {
        wrapped.extend(wrap(&paragraph.join(" "), hanging));
        wrapped.push(String::new());
    }
    wrapped.pop();
    wrapped
}

/// A text on as many lines as it takes.
pub(super) fn wrap(text: &str, hanging: usize) -> Vec<String> {
    let indent = text.len() - text.trim_start().len();
    let mut lines = Vec::new();
    let mut line = " ".repeat(indent);
    let mut is_empty = true;
    for word in text.split_whitespace() {
        // Of the width, three columns make a comment of it.
        if !is_empty && line.chars().count() + 1 + word.chars().count() > WIDTH - 3 {
            lines.push(std::mem::replace(&mut line, " ".repeat(indent + hanging)));
            is_empty = true;
        }
        if !is_empty {
            line.push(' ');
        }
        line.push_str(word);
        is_empty = false;
    }
    lines.push(line);
    lines
}

/// Documentation for users of Rust as a C programmer reads it: no links, no code marks.
pub(super) fn plain(line: &str) -> String {
    let mut text = String::new();
    let mut rest = line.trim();
    while let Some((before, after)) = rest.split_once("](") {
        // The bracket that this one closes.
        let Some((start, link)) = before.rsplit_once('[') else {
            text.push_str(before);
            text.push_str("](");
            rest = after;
            continue;
        };
        text.push_str(start);
        text.push_str(link);
        rest = after.split_once(')').map_or(after, |(_, rest)| rest);
    }
    let text = text + rest;
    // A link without a target is the name of something in Rust.
    let text = text.replace("[`", "`").replace("`]", "`");
    text.replace("crate::", "ulna::").replace('`', "")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_lose_their_targets_and_nothing_else() {
        let line = " of each joint's [`Friction`](crate::Friction), `[v; ω]` ([that](x) counts).";
        assert_eq!(
            plain(line),
            "of each joint's Friction, [v; ω] (that counts)."
        );
    }

    #[test]
    fn no_text_ends_its_comment() {
        let text = comment(&["a */ b // c /* d".to_owned(), String::new()]);
        assert_eq!(text, "/*\n * a * / b / / c / * d\n *\n */\n");
    }

    #[test]
    fn long_statements_are_broken_before_an_operator() {
        let long = format!("const x = {}1;", "(a_long_name * another) + ".repeat(12));
        let text = statement(&long);
        assert!(text.lines().all(|line| line.len() <= WIDTH), "{text}");
        let joined: Vec<&str> = text.split_whitespace().collect();
        let before: Vec<&str> = long.split_whitespace().collect();
        assert_eq!(joined, before);
        assert!(
            text.lines()
                .skip(1)
                .all(|line| line.starts_with("        + "))
        );
    }
}
