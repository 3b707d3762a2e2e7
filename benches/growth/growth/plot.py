"""The rows as a figure: growth.svg and growth.png."""

from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullLocator

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


PANELS = {
    "operations": "operations",
    "call_ns": "a call, release: ns",
    "dev_stack_kB": "a call, dev: kB of stack",
    "release_s": "to compile, release: s",
    "dev_s": "to compile, dev: s",
    "release_MB": "to compile, release: MB",
}


def draw(rows: list[dict], folder: Path):
    plt.rcParams.update({"svg.hashsalt": "growth", "svg.fonttype": "path", "font.size": 10})
    figure, axes = plt.subplots(2, 3, figsize=(12, 8), sharex=True, layout="constrained")
    for axis, (column, title) in zip(axes.flat, PANELS.items()):
        panel(axis, title, rows, column)
    for axis in axes[-1]:
        axis.set_xlabel("joints")
    figure.suptitle("Generated code of arms with oblique axes and full inertias")
    figure.legend(*axes[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=len(QUANTITIES), frameon=False)
    figure.savefig(folder / "growth.svg", metadata={"Date": None})
    figure.savefig(folder / "growth.png", dpi=150)
    plt.close(figure)


def panel(axis, title: str, rows: list[dict], column: str):
    """Both axes logarithmic: a power law is a straight line, its slope the power."""
    for quantity, (label, colour, mark) in QUANTITIES.items():
        points = [(row["joints"], row[column]) for row in rows if row["quantity"] == quantity and row.get(column)]
        axis.loglog(*zip(*points) if points else ([], []), label=label, color=colour, marker=mark, markersize=6, linewidth=1.4)
    axis.set_title(title, loc="left")
    sizes = sorted({row["joints"] for row in rows})
    axis.xaxis.set_major_locator(FixedLocator(sizes))
    axis.xaxis.set_minor_locator(NullLocator())
    axis.xaxis.set_major_formatter("{x:.0f}")
    axis.yaxis.set_major_locator(LogLocator(subs=[1, 3]))
    axis.yaxis.set_minor_locator(NullLocator())
    axis.yaxis.set_major_formatter(FuncFormatter(lambda number, _: f"{number:,g}"))
    axis.grid(color="0.88", linewidth=0.8)
    axis.spines[["top", "right"]].set_visible(False)
