"""Pictures with matplotlib, where it is installed: people see mm, mm/s and N.

    dashpot.plot.traces(model.traces("campaign/")).savefig("fit.png")
    dashpot.plot.sheet(dashpot.characterise("campaign/"))
"""

from . import _core


def _figure(rows: int, columns: int):
    try:
        from matplotlib.figure import Figure
    except ImportError as missing:
        raise _core.Error("plot: matplotlib is not installed; Debian's package is python3-matplotlib") from missing
    figure = Figure(figsize=(5 * columns, 3.5 * rows), layout="constrained")
    return figure, figure.subplots(rows, columns, squeeze=False)


def traces(made, record: int = 0):
    """Force over time, velocity and displacement, measured and modelled, and what is left between them.

    made: what DamperModel.traces() gives; record: which of them. Returns a matplotlib Figure.
    """
    one = made[record]
    columns = one["columns"]
    figure, ((in_time, over_velocity), (left, over_displacement)) = _figure(2, 2)
    time = columns["time [s]"]

    # Loops, as far as the record has the motion.
    axes = [(in_time, time, "Time (s)")]
    for panel, name, label in (
        (over_velocity, "velocity [m/s]", "Velocity (mm/s)"),
        (over_displacement, "displacement [m]", "Displacement (mm)"),
    ):
        if name in columns:
            axes.append((panel, 1000 * columns[name], label))
        else:
            panel.set_visible(False)
    for panel, x, label in axes:
        panel.plot(x, columns["measured [N]"], color="0.55", label="measured")
        panel.plot(x, columns["modelled [N]"], color="tab:blue", linewidth=1, label="modelled")
        panel.set(xlabel=label, ylabel="Force (N)")
    in_time.legend()
    left.plot(time, columns["residual [N]"], color="tab:blue", linewidth=0.8)
    left.set(xlabel="Time (s)", ylabel="Residual (N)")
    figure.suptitle(one["name"])
    return figure


def sheet(figures: dict):
    """Force at mid stroke over speed, a line per drive: figures as dashpot.characterise() gives them.

    Returns a matplotlib Figure.
    """
    figure, ((panel,),) = _figure(1, 1)
    for place, level in enumerate(figures["levels"]):
        drive = "every drive" if level["drive"] is None else f"{level['drive']:g} {figures['drive_unit']}"
        for side, mark in (("rebound", "o-"), ("compression", "s--")):
            points = [point[side] for point in level["speeds"] if point[side]]
            speeds = [1000 * point["mid_speed"] for point in points]
            forces = [point["mid_force"] for point in points]
            panel.plot(speeds, forces, mark, color=f"C{place}", label=f"{drive}, {side}", markersize=4)
    panel.set(xlabel="Speed (mm/s)", ylabel="Force at mid stroke (N)")
    panel.legend()
    return figure
