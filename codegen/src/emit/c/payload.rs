//! What an arm carries, from how a body is described to the numbers that its methods read.

use ulna::Payload;

use super::function::signature;
use super::lines::comment;
use super::target::Target;

/// The function's declaration, without a semicolon.
fn declaration(target: &Target<'_>) -> String {
    let (real, count) = (target.real(), Payload::PARAMETERS);
    let parameters = [
        format!("const {real} body[{count}]"),
        format!("{real} payload[{count}]"),
    ];
    signature(&target.own("payload"), &parameters)
}

/// The prototype with its docs.
pub(super) fn prototype(target: &Target<'_>) -> String {
    let docs = [
        "What the arm carries, as its methods read it: of a rigid body that is fixed to the tool, the inertial",
        "parameters about the origin of the last link's frame, in its axes. Whether a body can be like that is not looked at.",
        "",
        "body[10]: mass, kg; centroid (x, y, z) in the tool's frame, m; inertia about the centroid in the tool's axes",
        "    (xx, xy, xz, yy, yz, zz), kg·m²: products with the tensor's sign",
        "payload[10]: m, kg; m c (x, y, z), kg·m; inertia (xx, xy, xz, yy, yz, zz), kg·m²; all 0 for nothing",
    ];
    let docs: Vec<String> = docs.map(str::to_owned).to_vec();
    format!("{}{};\n", comment(&docs), declaration(target))
}

/// The function.
pub(super) fn definition(target: &Target<'_>) -> String {
    let real = target.real();
    let tool = target.model.tool();
    let row = |row: &[f64; 3]| {
        let numbers = row.map(|x| target.number(x));
        format!("{{ {} }}", numbers.join(", "))
    };
    let rotation: Vec<String> = tool.rotation.iter().map(row).collect();
    format!(
        "/* r, p: rotation and place of the tool in the last link's frame. */
{declaration}
{{
    static const {real} r[3][3] = {{ {rotation} }};
    static const {real} p[3] = {translation};
    /* Where the entries of a symmetric tensor stand. */
    static const size_t place[3][3] = {{ {{ 4U, 5U, 6U }}, {{ 5U, 7U, 8U }}, {{ 6U, 8U, 9U }} }};
    {real} c[3];
    {real} square = {zero};
    size_t i;
    size_t j;
    size_t k;
    for (i = 0U; i < 3U; i++)
    {{
        c[i] = p[i];
        for (k = 0U; k < 3U; k++)
        {{
            c[i] += r[i][k] * body[1U + k];
        }}
        square += c[i] * c[i];
    }}
    payload[0] = body[0];
    for (i = 0U; i < 3U; i++)
    {{
        payload[1U + i] = body[0] * c[i];
        for (j = i; j < 3U; j++)
        {{
            /* Huygens and Steiner. */
            {real} entry = -(body[0] * (c[i] * c[j]));
            if (i == j)
            {{
                entry += body[0] * square;
            }}
            for (k = 0U; k < 3U; k++)
            {{
                {real} turned = {zero};
                size_t l;
                for (l = 0U; l < 3U; l++)
                {{
                    turned += body[place[k][l]] * r[j][l];
                }}
                entry += r[i][k] * turned;
            }}
            payload[place[i][j]] = entry;
        }}
    }}
}}
",
        declaration = declaration(target),
        rotation = rotation.join(", "),
        translation = row(&tool.translation),
        zero = target.number(0.0),
    )
}
