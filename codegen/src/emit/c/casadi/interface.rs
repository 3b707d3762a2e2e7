//! What CasADi looks up of a function: how it is called, and what its inputs and outputs are.

use std::fmt::Write as _;

/// A function by CasADi's calling convention. Inputs and outputs are names with sparsities.
#[derive(Debug)]
pub(super) struct Interface {
    pub(super) name: String,
    pub(super) inputs: Vec<(String, Vec<usize>)>,
    pub(super) outputs: Vec<(String, Vec<usize>)>,
}

impl Interface {
    /// The call that returns an output's sparsity.
    pub(super) fn sparsity_of(&self, output: usize) -> String {
        format!("{}_sparsity_out({output})", self.name)
    }

    /// The prototypes of all its functions, under a comment that says what goes in and out.
    pub(super) fn prototypes(&self) -> String {
        let list = |items: &[(String, Vec<usize>)]| {
            let items: Vec<String> = items.iter().map(described).collect();
            items.join(",\n *     ")
        };
        let (inputs, outputs) = (list(&self.inputs), list(&self.outputs));
        let mut text = format!("\n/* From {inputs}\n * to  {outputs}\n */\n");
        for (signature, _) in self.functions("") {
            // Writing to a String does not fail.
            let _ = writeln!(text, "{signature};");
        }
        text
    }

    /// All its functions; `body` are the statements that compute the outputs.
    pub(super) fn definitions(&self, body: &str) -> String {
        let mut text = String::new();
        for (signature, body) in self.functions(body) {
            let _ = write!(text, "\n{signature}\n{{\n{body}}}\n");
        }
        text
    }

    /// The signature and body of each function.
    fn functions(&self, body: &str) -> Vec<(String, String)> {
        let name = &self.name;
        let count = |items: &[(String, Vec<usize>)]| format!("    return {};\n", items.len());
        let text = |kind: &str, items: &[(String, Vec<usize>)]| {
            let texts: Vec<String> = items
                .iter()
                .map(|(name, _)| format!("\"{name}\""))
                .collect();
            let (length, texts) = (items.len(), texts.join(", "));
            (
                format!("const char *{name}_name_{kind}(long long int i)"),
                format!(
                    "    static const char *const names[{length}] = {{{texts}}};\n\n    \
                     return ((i >= 0) && (i < {length})) ? names[i] : NULL;\n"
                ),
            )
        };
        let pattern = |kind: &str, items: &[(String, Vec<usize>)]| {
            let mut body = String::new();
            for (name, sparsity) in items {
                let numbers: Vec<String> = sparsity.iter().map(ToString::to_string).collect();
                let (length, numbers) = (sparsity.len(), filled(&numbers));
                // Writing to a String does not fail.
                let _ = writeln!(
                    body,
                    "    static const long long int {name}[{length}] = {{{numbers}}};"
                );
            }
            let names: Vec<String> = items.iter().map(|(name, _)| name.clone()).collect();
            let (length, names) = (items.len(), filled(&names));
            let _ = write!(
                body,
                "    static const long long int *const patterns[{length}] = {{{names}}};\n\n    \
                 return ((i >= 0) && (i < {length})) ? patterns[i] : NULL;\n"
            );
            (
                format!("const long long int *{name}_sparsity_{kind}(long long int i)"),
                body,
            )
        };
        let (inputs, outputs) = (self.inputs.len(), self.outputs.len());
        vec![
            (
                format!(
                    "int {name}(const double **arg, double **res, long long int *iw, double *w, int mem)"
                ),
                format!("{body}    (void)iw;\n    (void)w;\n    (void)mem;\n    return 0;\n"),
            ),
            (
                format!(
                    "int {name}_work(long long int *sz_arg, long long int *sz_res, long long int *sz_iw, long long int *sz_w)"
                ),
                format!("    return sizes({inputs}, {outputs}, sz_arg, sz_res, sz_iw, sz_w);\n",),
            ),
            (
                format!("long long int {name}_n_in(void)"),
                count(&self.inputs),
            ),
            (
                format!("long long int {name}_n_out(void)"),
                count(&self.outputs),
            ),
            text("in", &self.inputs),
            text("out", &self.outputs),
            pattern("in", &self.inputs),
            pattern("out", &self.outputs),
            (
                format!("double {name}_default_in(long long int i)"),
                "    (void)i;\n    return 0.0;\n".to_owned(),
            ),
            // Nothing is kept between calls.
            (
                format!("int {name}_checkout(void)"),
                "    return 0;\n".to_owned(),
            ),
            (
                format!("void {name}_release(int mem)"),
                "    (void)mem;\n".to_owned(),
            ),
            (format!("void {name}_incref(void)"), String::new()),
            (format!("void {name}_decref(void)"), String::new()),
        ]
    }
}

/// A name with rows, columns, and how many entries there are if some are not.
fn described((name, sparsity): &(String, Vec<usize>)) -> String {
    let (rows, columns) = (sparsity[0], sparsity[1]);
    let size = if columns == 1 {
        rows.to_string()
    } else {
        format!("{rows}x{columns}")
    };
    match sparsity.get(2 + columns) {
        // A full matrix is told by a third number alone.
        None if sparsity.len() == 3 => format!("{name}[{size}]"),
        entries => format!("{name}[{size}, {} entries]", entries.copied().unwrap_or(0)),
    }
}

/// Numbers or names with commas between them; many are broken into lines.
fn filled(items: &[String]) -> String {
    if items.iter().map(|item| item.len() + 2).sum::<usize>() <= 40 {
        return items.join(", ");
    }
    let mut lines = vec![String::new()];
    for item in items {
        let last = lines.last().map_or(0, String::len);
        if last > 0 && last + item.len() > 88 {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            let separator = if line.is_empty() { "" } else { " " };
            let _ = write!(line, "{separator}{item},");
        }
    }
    let lines = lines.join("\n        ");
    format!("\n        {}\n    ", lines.trim_end_matches(','))
}
