//! What the functions of a file share, each there if it is called: how coordinates are read, where a task is singular, zeros.
//!
//! They are the rules of [`PLAIN_LIMIT`], [`PRISMATIC_LIMIT`] and [`ulna::arm::singular`], so that no method returns NaN for
//! coordinates that are finite.

use std::f64::consts::PI;

use ulna::arm::singular::least_volume_squared;
use ulna::arm::{PLAIN_LIMIT, PRISMATIC_LIMIT};
use ulna::{JointKind, TaskRow};

use super::target::Target;

/// The helpers that `code` calls, each before those that call it.
pub(super) fn helpers(target: &Target<'_>, code: &str) -> String {
    let singular = calls(target, code, "is_singular").then(|| is_singular(target));
    let with_singular = format!("{code}{}", singular.as_deref().unwrap_or_default());
    let is_called = |name| calls(target, &with_singular, name);
    [
        is_called("angle").then(|| angle(target)),
        is_called("offset").then(|| offset(target)),
        singular,
        is_called("clear").then(|| clear(target)),
    ]
    .into_iter()
    .flatten()
    .map(|helper| helper + "\n")
    .collect()
}

fn calls(target: &Target<'_>, code: &str, name: &str) -> bool {
    code.contains(&format!("{}(", target.own(name)))
}

/// Sine and cosine of the angle itself are exact however large it is; its sum with others would not be. Newton's method on
/// sin(q - angle) begins less than 0.58 rad away and leaves the cube of an error, divided by 6: after three steps less than 1e-16.
fn angle(target: &Target<'_>) -> String {
    let (real, name) = (target.real(), target.own("angle"));
    let (sin, cos) = (target.math("sin"), target.math("cos"));
    let [zero, limit, half_turn] = [0.0, PLAIN_LIMIT, PI].map(|x| target.number(x));
    format!(
        "/*
 * How the coordinate of a revolute joint is read, rad: as it is up to {PLAIN_LIMIT} rad, beyond that as the
 * same angle within a half turn. NaN if it is not finite.
 */
static {real} {name}({real} q)
{{
    {real} angle = q;
    if (!((q >= -{limit}) && (q <= {limit})))
    {{
        const {real} s = {sin}(q);
        const {real} c = {cos}(q);
        int step;
        angle = s;
        if (c < {zero})
        {{
            angle = {half_turn} - s;
            if (s < {zero})
            {{
                angle = -{half_turn} - s;
            }}
        }}
        /* Newton's method: three steps are enough. */
        for (step = 0; step < 4; step++)
        {{
            angle += (s * {cos}(angle)) - (c * {sin}(angle));
        }}
    }}
    return angle;
}}
",
    )
}

fn offset(target: &Target<'_>) -> String {
    let (real, name) = (target.real(), target.own("offset"));
    let [zero, limit] = [0.0, PRISMATIC_LIMIT].map(|x| target.number(x));
    format!(
        "/*
 * How the coordinate of a prismatic joint is read, m: within {PRISMATIC_LIMIT} m either way. NaN if it is
 * not finite.
 */
static {real} {name}({real} q)
{{
    {real} offset = q;
    if (q > {limit})
    {{
        offset = {limit} + (q * {zero});
    }}
    if (q < -{limit})
    {{
        offset = (q * {zero}) - {limit};
    }}
    return offset;
}}
",
    )
}

fn clear(target: &Target<'_>) -> String {
    let (real, name, zero) = (target.real(), target.own("clear"), target.number(0.0));
    format!(
        "/* Sets numbers to 0. */
static void {name}({real} numbers[], size_t count)
{{
    size_t i;
    for (i = 0U; i < count; i++)
    {{
        numbers[i] = {zero};
    }}
}}
"
    )
}

fn is_singular(target: &Target<'_>) -> String {
    let (real, name, largest) = (target.real(), target.own("is_singular"), target.largest());
    let joints = target.joints().len();
    format!(
        "/*
 * Whether the task is singular at q, where volume_squared is det(JJᵀ) over its rows: the square root
 * is within 16 N epsilon of 0, rows of the velocity divided by the length of the chain. A
 * volume that is NaN has been divided by a row of length 0.
 */
static bool {name}(const {real} q[{joints}], {real} volume_squared)
{{
{least}    bool singular = !(volume_squared > least);
    size_t i;
    for (i = 0U; i < {joints}U; i++)
    {{
        if (!((q[i] >= -{largest}) && (q[i] <= {largest})))
        {{
            singular = false;
        }}
    }}
    return singular;
}}
",
        least = least(target),
    )
}

/// The statements that find the `least` volume, squared, that counts as one.
fn least(target: &Target<'_>) -> String {
    let real = target.real();
    let joints = target.joints();
    let model = target.model;
    let slides = |joint: &usize| joints[*joint].kind == JointKind::Prismatic;
    let sliding: Vec<usize> = (0..joints.len()).filter(slides).collect();
    let precision = target.epsilon() / f64::EPSILON;
    if sliding.is_empty() {
        let q = vec![0.0; joints.len()];
        let least = least_volume_squared(joints, model.tool(), model.task(), &q);
        let least = target.number(least * precision * precision);
        return format!("    const {real} least = {least};\n");
    }
    // The length of the chain but for what slides, as `ulna::arm::singular::length` adds it up.
    let fixed: f64 = model.tool().translation.iter().map(|x| x.abs()).sum();
    let fixed = joints
        .iter()
        .fold(fixed, |sum, joint| sum + joint.a.abs() + joint.d.abs());
    let [zero, one, fixed] = [0.0, 1.0, fixed].map(|x| target.number(x));
    #[expect(clippy::cast_precision_loss, reason = "joints are few")]
    let rounding = target.number(16.0 * joints.len() as f64 * target.epsilon());
    let mut text = format!("    {real} length = {fixed};\n    {real} least = {rounding};\n");
    for joint in sliding {
        let (name, offset) = (format!("q_{}", joint + 1), target.own("offset"));
        text += &format!(
            "    const {real} {name} = {offset}(q[{joint}]);
    if ({name} < {zero})
    {{
        length -= {name};
    }}
    else
    {{
        length += {name};
    }}
"
        );
    }
    text += &format!("    if (length < {one})\n    {{\n        length = {one};\n    }}\n");
    let velocities = TaskRow::ALL[..3].iter();
    for _ in velocities.filter(|row| model.task().contains(**row)) {
        text += "    least *= length;\n";
    }
    text + "    least *= least;\n"
}
