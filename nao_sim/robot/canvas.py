"""Draws a model off screen: finely, or fast enough for a robot's eyes without a graphics card.

In software every pixel counts. The fast way leaves out shadows, reflections, haze and multisampling, paints the sky
in one colour, blends no mipmap levels, and sends only what the camera can see.
"""

from __future__ import annotations

import mujoco
import numpy as np

from nao_sim.robot.view import View, view_of

_MAX_GEOMS = 10_000
_HIDDEN_GROUP = 5
"""A geom group that MuJoCo does not draw by default."""

_COSTLY = (
    mujoco.mjtRndFlag.mjRND_SHADOW,
    mujoco.mjtRndFlag.mjRND_REFLECTION,
    mujoco.mjtRndFlag.mjRND_SKYBOX,
    mujoco.mjtRndFlag.mjRND_FOG,
    mujoco.mjtRndFlag.mjRND_HAZE,
)
_SKY_GLOW = 1000.0
"""The painted sky shines by itself, this much brighter than the lamps make it."""


class Canvas:
    """Pictures of one model at one size; holds an OpenGL context.

    Args:
        model: the model.
        width, height: pixels.
        fine: with shadows, reflections, sky texture and smoothed edges.
    """

    def __init__(self, model: mujoco.MjModel, width: int, height: int, fine: bool) -> None:
        self._model, self._fine = model, fine
        self._gl = mujoco.GLContext(width, height)
        self._gl.make_current()
        self._context = _context(model, fine)
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, self._context)
        # Clearing a larger buffer than the picture took half a millisecond.
        mujoco.mjr_resizeOffscreen(width, height, self._context)
        self._scene = mujoco.MjvScene(model, maxgeom=_MAX_GEOMS)
        self._option = mujoco.MjvOption()
        self._rect = mujoco.MjrRect(0, 0, width, height)
        self._pixels = np.empty((height, width, 3), np.uint8)
        self._has_sky = bool((model.tex_type == mujoco.mjtTexture.mjTEXTURE_SKYBOX).any())
        if not fine:
            for flag in _COSTLY:
                self._scene.flags[flag] = 0
            _coarsen_textures(self._context)

    def draw(self, data: mujoco.MjData, camera: mujoco.MjvCamera) -> np.ndarray:
        """Return a new ``(height, width, 3)`` uint8 RGB picture."""
        self._gl.make_current()
        if self._fine:
            self._update(data, camera)
        else:
            mujoco.mjv_updateCamera(self._model, data, camera, self._scene)
            view = view_of(self._scene, self._rect.width / self._rect.height)
            self._update_seen(data, camera, view)
            if self._has_sky:
                self._paint_sky(view)
        mujoco.mjr_render(self._rect, self._scene, self._context)
        mujoco.mjr_readPixels(self._pixels, None, self._rect, self._context)
        # OpenGL's first row is the lowest.
        return self._pixels[::-1].copy()

    def close(self) -> None:
        """Free the OpenGL context; the canvas cannot draw any more."""
        self._gl.make_current()
        self._context.free()
        self._gl.free()

    def _update(self, data: mujoco.MjData, camera: mujoco.MjvCamera) -> None:
        everything = mujoco.mjtCatBit.mjCAT_ALL
        mujoco.mjv_updateScene(self._model, data, self._option, None, camera, everything, self._scene)

    def _update_seen(self, data: mujoco.MjData, camera: mujoco.MjvCamera, view: View) -> None:
        """Leave out geoms the camera cannot see; without shadows they change nothing in the picture."""
        groups = self._model.geom_group
        kept = groups.copy()
        groups[~view.sees(data.geom_xpos, self._model.geom_rbound)] = _HIDDEN_GROUP
        try:
            self._update(data, camera)
        finally:
            groups[:] = kept

    def _paint_sky(self, view: View) -> None:
        """Hang a screen of the haze's colour behind everything."""
        scene = self._scene
        if scene.ngeom >= scene.maxgeom:
            return
        # A plane's front is where its z axis points: at the camera, as the view's own z axis does.
        centre, size = view.screen()
        colour = np.append(self._model.vis.rgba.haze[:3] / _SKY_GLOW, 1).astype(np.float32)
        sky = scene.geoms[scene.ngeom]
        mujoco.mjv_initGeom(sky, mujoco.mjtGeom.mjGEOM_PLANE, size, centre, view.axes.ravel(), colour)
        sky.category = mujoco.mjtCatBit.mjCAT_DECOR
        sky.emission, sky.specular, sky.shininess = _SKY_GLOW, 0, 0
        scene.ngeom += 1


def _context(model: mujoco.MjModel, fine: bool) -> mujoco.MjrContext:
    """Upload the model; without multisampling, which in software costs as much as the picture itself, unless fine."""
    quality = model.vis.quality
    samples, shadows = quality.offsamples, quality.shadowsize
    if not fine:
        quality.offsamples = quality.shadowsize = 0
    try:
        return mujoco.MjrContext(model, mujoco.mjtFontScale.mjFONTSCALE_100)
    finally:
        quality.offsamples, quality.shadowsize = samples, shadows


def _coarsen_textures(context: mujoco.MjrContext) -> None:
    """Take each texel from one mipmap level instead of blending two, in the current OpenGL context."""
    from OpenGL import GL  # type: ignore[import-untyped]  # comes with MuJoCo; looks for a library when imported

    kinds = zip(context.texture[: context.ntexture], context.textureType, strict=False)
    for texture in [int(name) for name, kind in kinds if kind == mujoco.mjtTexture.mjTEXTURE_2D]:
        GL.glBindTexture(GL.GL_TEXTURE_2D, texture)
        GL.glTexParameteri(GL.GL_TEXTURE_2D, GL.GL_TEXTURE_MIN_FILTER, GL.GL_LINEAR_MIPMAP_NEAREST)
