"""One renderer for a whole data set: a person, a room, lights and a camera that are rewritten between clips.

The camera never moves during a clip, so the room is rendered once, with shadows, and each frame renders the person
alone and lays it over the room by depth. New textures, contexts and compilations are what costs; there are none.
"""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import mujoco
import numpy as np
from numpy.typing import NDArray

from nao_sim.people.actors.clothes import Outfit, dress, thicknesses
from nao_sim.people.actors.figure import HIDDEN_GROUP, Figure, skeleton
from nao_sim.people.actors.persons import Person, body_scales
from nao_sim.people.arrays import Array, Image
from nao_sim.people.errors import FilmError
from nao_sim.people.filming.camera import Camera, Light, View
from nao_sim.people.filming.floor_shadow import shade_floor
from nao_sim.people.filming.rooms import BOX, MAX_ITEMS, TEXTURES, Item, texture_images
from nao_sim.rendering import HOW_TO_GET_GL

MAX_WIDTH, MAX_HEIGHT = 1280, 960
# No part of a person is further (m) than this from the nearest joint: hair, skirts and finger tips have room to spare.
_AROUND_JOINTS = 0.4


class Stage:
    """Renders persons in rooms; a context manager, because it holds an OpenGL context."""

    def __init__(self, detail: float = 1.0) -> None:
        self.figure = Figure(detail)
        spec = skeleton()
        self.figure.add_to(spec)
        _add_room(spec)
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        self._items = [self.model.geom(f"item_{k}").id for k in range(MAX_ITEMS)]
        self._ankles = [self.model.body(f"{side}_foot").id for side in "rl"]
        # Compiled at the origin they count as sharing the world's frame, and would stay there.
        self.model.geom_sameframe[self._items] = mujoco.mjtSameFrame.mjSAMEFRAME_NONE.value
        try:
            self._gl = mujoco.GLContext(MAX_WIDTH, MAX_HEIGHT)
            self._gl.make_current()
            self._context = mujoco.MjrContext(self.model, mujoco.mjtFontScale.mjFONTSCALE_100)
        except (AttributeError, RuntimeError, mujoco.FatalError) as error:
            raise FilmError(f"persons cannot be rendered without OpenGL; {HOW_TO_GET_GL}") from error
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, self._context)
        self._scene = mujoco.MjvScene(self.model, maxgeom=200)
        self._scene.flags[mujoco.mjtRndFlag.mjRND_REFLECTION] = 0
        self._scene.flags[mujoco.mjtRndFlag.mjRND_SKYBOX] = 0
        self._view = mujoco.MjvCamera()
        self._view.type, self._view.fixedcamid = mujoco.mjtCamera.mjCAMERA_FIXED, self.model.camera("film").id
        self._option = mujoco.MjvOption()
        self._option.skingroup[HIDDEN_GROUP] = 0
        self._size = (0, 0)

    def __enter__(self) -> Stage:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Free the OpenGL context; the stage cannot render any more."""
        self._context.free()
        self._gl.free()

    def set_size(self, width: int, height: int) -> None:
        """Choose the frame size in pixels, and make this stage the one that OpenGL draws on."""
        self._gl.make_current()
        if (width, height) == self._size:
            return
        if not (16 <= width <= MAX_WIDTH and 16 <= height <= MAX_HEIGHT):
            raise FilmError(f"frame size {width}x{height} is outside 16x16 to {MAX_WIDTH}x{MAX_HEIGHT}")
        mujoco.mjr_resizeOffscreen(width, height, self._context)
        self._size = (width, height)
        self._rect = mujoco.MjrRect(0, 0, width, height)

    def cast(self, person: Person, outfit: Outfit) -> None:
        """Put ``person`` in ``outfit`` on the stage."""
        self.figure.reshape(self.model, body_scales(person), thicknesses(outfit))
        dress(self.model, person, outfit)

    def show_only(self, parts: Sequence[str]) -> None:
        """Hide all of the person that is cast but these parts."""
        for skin in range(self.model.nskin):
            if mujoco.mj_id2name(self.model, mujoco.mjtObj.mjOBJ_SKIN, skin) not in parts:
                self.model.skin_group[skin] = HIDDEN_GROUP

    def body_position(self, angles: Array, body: str) -> Array:
        """World position (3,) in m of a body of the person at ``angles`` (nq,)."""
        self.data.qpos[:] = angles
        mujoco.mj_kinematics(self.model, self.data)
        return np.array(self.data.body(body).xpos)

    def furnish(self, room: list[Item]) -> None:
        """Replace the room."""
        model = self.model
        for geom, item in zip(self._items, room, strict=False):
            model.geom_type[geom] = item.kind
            model.geom_pos[geom], model.geom_size[geom] = item.pos, item.size
            model.geom_quat[geom] = (1, 0, 0, 0) if item.quat is None else item.quat
            model.geom_rgba[geom] = (*item.rgb, 1.0)
            model.geom_matid[geom] = model.material(f"room_{item.texture}").id
            model.geom_group[geom] = 1
        for geom in self._items[len(room) :]:
            model.geom_group[geom] = HIDDEN_GROUP

    def light(self, light: Light) -> None:
        """Replace the light."""
        model = self.model
        for k, (direction, strength) in enumerate(((light.key_dir, light.key), (light.fill_dir, light.fill))):
            model.light_dir[k] = np.array(direction) / np.linalg.norm(direction)
            model.light_diffuse[k] = strength
        model.light_ambient[1] = light.ambient

    def aim(self, camera: Camera) -> None:
        """Place the camera."""
        self._camera = camera
        model, k = self.model, self._view.fixedcamid
        model.cam_pos[k], model.cam_fovy[k] = camera.pos, camera.fovy_deg
        mujoco.mju_mat2Quat(model.cam_quat[k], camera.frame().ravel())

    def room_image(self) -> Image:
        """Render the empty room with shadows and keep it as the background; RGB (h, w, 3), the first row at the top."""
        self._seen = View(self._camera, *self._size)
        self._scene_of(groups=(1,), person=False, shadows=True)
        self._room, self._room_depth = self._pixels(self._rect)
        self._shaded, self._feet = self._room, np.zeros((2, 2))
        return np.asarray(cv2.flip(self._room, 0), dtype=np.uint8)

    def image(self, angles: Array) -> Image:
        """Render the person at ``angles`` (nq,) before the room of :meth:`room_image`; RGB (h, w, 3)."""
        self.data.qpos[:] = angles
        self._scene_of(groups=(), person=True, shadows=False)
        left, bottom, width, height = self._seen.box(self.data.xpos[1:], _AROUND_JOINTS)
        person, depth = self._pixels(mujoco.MjrRect(left, bottom, width, height))
        self._shade()
        picture = self._shaded.copy()
        place = slice(bottom, bottom + height), slice(left, left + width)
        cv2.copyTo(person, (depth < self._room_depth[place]).view(np.uint8), picture[place])
        # OpenGL's rows start at the bottom.
        return np.asarray(cv2.flip(picture, 0), dtype=np.uint8)

    def _shade(self) -> None:
        """Lay the spot under the person over the room, anew only when the feet have moved by two pixels."""
        ankles = self.data.xpos[self._ankles]
        feet, scale = self._seen.pixels(ankles)
        if (feet[:, 1] < -scale).all() or np.abs(feet - self._feet).max() < 2.0:
            return
        self._shaded, self._feet = self._room.copy(), feet
        shade_floor(self._shaded, ankles, self._seen)

    def _scene_of(self, groups: tuple[int, ...], person: bool, shadows: bool) -> None:
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_camlight(self.model, self.data)
        self._option.geomgroup[:] = 0
        self._option.geomgroup[list(groups)] = 1
        self._option.skingroup[0] = person
        self._scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = shadows
        everything = mujoco.mjtCatBit.mjCAT_ALL.value
        mujoco.mjv_updateScene(self.model, self.data, self._option, None, self._view, everything, self._scene)
        mujoco.mjr_render(self._rect, self._scene, self._context)

    def _pixels(self, rect: mujoco.MjrRect) -> tuple[Image, NDArray[np.float32]]:
        """Colours (h, w, 3) and depths (h, w) of a part of what was rendered."""
        rgb, depth = np.empty((rect.height, rect.width, 3), np.uint8), np.empty((rect.height, rect.width), np.float32)
        mujoco.mjr_readPixels(rgb, depth, rect, self._context)
        return rgb, depth


def _add_room(spec: mujoco.MjSpec) -> None:
    """Add lights, the camera, the texture library and the items that rooms are made of."""
    spec.visual.quality.offsamples = 0
    spec.visual.quality.shadowsize = 1024
    spec.visual.global_.offwidth, spec.visual.global_.offheight = MAX_WIDTH, MAX_HEIGHT
    spec.visual.headlight.active = 0  # a third light would cost a seventh of the time
    spec.visual.map.znear, spec.visual.map.zfar = 0.02, 40.0
    spec.stat.extent, spec.stat.center = 1.0, [0.0, 0.0, 1.0]
    spec.visual.map.shadowclip = 9.0
    world = spec.worldbody
    for k in range(2):
        world.add_light(
            name=f"light_{k}",
            type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL,
            pos=[2.0, 0.0, 3.0],
            dir=[-1.0, 0.0, -1.0],
            castshadow=k == 0,
            specular=[0.0] * 3,
        )
    world.add_camera(name="film")
    for name, image in texture_images().items():
        repeat = TEXTURES[name]
        size = image.shape[0]
        texture = spec.add_texture(
            name=f"room_{name}", type=mujoco.mjtTexture.mjTEXTURE_2D, width=size, height=size, nchannel=3
        )
        texture.data = image.tobytes()
        material = spec.add_material(
            name=f"room_{name}", texrepeat=[repeat or 1.0] * 2, texuniform=repeat > 0, specular=0.0, shininess=0.0
        )
        material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = f"room_{name}"
    for k in range(MAX_ITEMS):
        world.add_geom(name=f"item_{k}", type=BOX, size=[0.1, 0.1, 0.1], contype=0, conaffinity=0, group=HIDDEN_GROUP,
                       material="room_plain")  # fmt: skip
