"""Make the pictures of models/nao: ``python tools/render_nao.py`` (needs EGL or OSMesa)."""

from __future__ import annotations

from pathlib import Path

import cv2

from nao_sim.robot import Nao

FOLDER = Path(__file__).resolve().parents[1] / "models" / "nao"

# name -> posture, azimuth, elevation, distance, point looked at, width, height
VIEWS = {
    "nao_front": ("StandInit", 180, -5, 0.95, (0, 0, 0.29), 480, 640),
    "nao_side": ("StandInit", 110, -8, 0.95, (0, 0, 0.29), 480, 640),
    "nao_back": ("StandInit", 20, -10, 0.95, (0, 0, 0.29), 480, 640),
    "nao": ("Stand", 152, -10, 0.95, (0, 0, 0.29), 560, 600),
    "nao_face": ("Stand", 158, -4, 0.36, (0.02, 0, 0.505), 640, 480),
}


def main() -> None:
    """Render every view."""
    import mujoco  # after nao_sim, which chooses how it renders

    model = None
    for name, (posture, azimuth, elevation, distance, lookat, width, height) in VIEWS.items():
        with Nao(posture=posture, model=model) as nao:
            model = nao.model
            model.vis.quality.shadowsize = 8192
            model.vis.quality.offsamples = 8
            nao.set_angles(["LHand", "RHand"], 0.8)
            nao.step(50)
            camera = mujoco.MjvCamera()
            camera.azimuth, camera.elevation, camera.distance = azimuth, elevation, distance
            camera.lookat[:] = lookat
            picture = nao.camera(camera, 2 * width, 2 * height, fine=True)
        small = cv2.resize(picture, (width, height), interpolation=cv2.INTER_AREA)
        cv2.imwrite(str(FOLDER / f"{name}.png"), small[:, :, ::-1], [cv2.IMWRITE_PNG_COMPRESSION, 9])


if __name__ == "__main__":
    main()
