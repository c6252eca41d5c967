"""A motion as a Parquet table, one row every control period, one column a quantity."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from nao_sim.motion import MotionLog

_TORSO = (("x", "m"), ("y", "m"), ("z", "m"), ("qw", "1"), ("qx", "1"), ("qy", "1"), ("qz", "1"))
_FSR = tuple(f"{side}Fsr{place}" for side in "LR" for place in ("FL", "FR", "RL", "RR"))


def write_table(path: Path, log: MotionLog, names: tuple[str, ...], metadata: dict[str, str]) -> None:
    """Write a motion.

    Columns are ``time`` [s]; for each joint ``<joint>.target`` and ``<joint>.angle`` [rad, hands 0 … 1],
    ``<joint>.velocity`` [rad/s], ``<joint>.torque`` [Nm]; ``torso.x`` … ``torso.qz`` in the world frame; one
    column for each foot force sensor [N]. Units stand in each column's metadata under ``unit``.

    Args:
        path: the file to write.
        log: the motion.
        names: the actuated joints, in the order of the log's columns.
        metadata: kept with the table's schema.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    columns: list[tuple[str, str, np.ndarray]] = [("time", "s", log.time)]
    for j, name in enumerate(names):
        unit = "1" if name.endswith("Hand") else "rad"
        columns.append((f"{name}.target", unit, log.targets[:, j]))
        columns.append((f"{name}.angle", unit, log.angles[:, j]))
        columns.append((f"{name}.velocity", f"{unit}/s", log.velocities[:, j]))
        columns.append((f"{name}.torque", "N m", log.torques[:, j]))
    columns += [(f"torso.{key}", unit, log.torso_pose[:, i]) for i, (key, unit) in enumerate(_TORSO)]
    columns += [(name, "N", log.contacts[:, i]) for i, name in enumerate(_FSR)]
    fields = [pa.field(name, pa.float64(), metadata={"unit": unit}) for name, unit, _ in columns]
    arrays = [pa.array(np.ascontiguousarray(values)) for _, _, values in columns]
    pq.write_table(pa.Table.from_arrays(arrays, schema=pa.schema(fields, metadata=metadata)), path)
