"""The rows as a figure: growth.svg and growth.png."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from .measure import Row

# Colours that stay apart for the colour-blind (Okabe and Ito), and a mark each for print without colours.
QUANTITIES = {
    "geometric_jacobian": ("J", "#56B4E9", "o"),
    "jacobian_derivatives": ("all ∂J/∂qᵢ", "#0072B2", "s"),
    "mass_matrix": ("M", "#009E73", "^"),
    "mass_matrix_derivatives": ("all ∂M/∂qᵢ", "#D55E00", "D"),
    "dynamic_manipulability_gradient": ("w_D and ∇w_D", "#CC79A7", "v"),
    "inverse_dynamics": ("inverse dynamics", "#E69F00", "P"),
    "forward_dynamics": ("forward dynamics", "#000000", "X"),
}


def draw(rows: list[Row], folder: Path):
    def of_build(profile, value):
        def get(row):
            build = row.builds.get(profile)
            return value(build) if build and not build.cost.fault else None

        return get

    panels = [
        ("operations", lambda row: row.operations),
        ("a call, release: ns", lambda row: row.nanoseconds),
        ("a call, dev: kB of stack", of_build("dev", lambda build: build.stack)),
        ("to compile, release: s", of_build("release", lambda build: build.cost.seconds)),
        ("to compile, dev: s", of_build("dev", lambda build: build.cost.seconds)),
        ("to compile, release: MB", of_build("release", lambda build: build.cost.megabytes)),
    ]
    plt.rcParams.update({"svg.hashsalt": "growth", "svg.fonttype": "path", "font.size": 10})
    figure, axes = plt.subplots(2, 3, figsize=(12, 8), sharex=True, layout="constrained")
    for axis, (title, value) in zip(axes.flat, panels):
        panel(axis, title, rows, value)
    for axis in axes[-1]:
        axis.set_xlabel("joints")
    figure.suptitle("Generated code of arms with oblique axes and full inertias")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=len(QUANTITIES), frameon=False)
    figure.savefig(folder / "growth.svg", metadata={"Date": None})
    figure.savefig(folder / "growth.png", dpi=150)
    plt.close(figure)


def panel(axis, title: str, rows: list[Row], value):
    """Both axes logarithmic: a power law is a straight line, its slope the power."""
    for quantity, (label, colour, mark) in QUANTITIES.items():
        points = [(row.joints, value(row)) for row in rows if row.quantity == quantity]
        points = [point for point in points if point[1]]
        axis.loglog(*zip(*points) if points else ([], []), label=label, color=colour, marker=mark, markersize=6, linewidth=1.4)
    axis.set_title(title, loc="left")
    sizes = sorted({row.joints for row in rows})
    axis.xaxis.set_major_locator(FixedLocator(sizes))
    axis.xaxis.set_minor_locator(NullLocator())
    axis.xaxis.set_major_formatter("{x:.0f}")
    axis.yaxis.set_major_formatter(FuncFormatter(lambda number, _: f"{number:,g}"))
    axis.grid(color="0.88", linewidth=0.8)
    axis.spines[["top", "right"]].set_visible(False)
