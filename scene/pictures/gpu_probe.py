"""Whether Blender can draw with its GPU engines here. Asked before rendering: without EGL Blender aborts."""

from __future__ import annotations

import ctypes
import functools
import sys

EGL_PLATFORM_SURFACELESS = 0x31DD
EGL_PLATFORM_DEVICE = 0x313F

REMEDY = (
    "Workbench and EEVEE need EGL to render without a window, and it is missing: rendering with Cycles instead "
    "(on Debian and Ubuntu, install libegl1 and libgl1-mesa-dri)"
)


@functools.lru_cache(maxsize=1)
def can_draw() -> bool:
    """Whether Workbench and EEVEE can render: always with a window, in background on Linux only with EGL."""
    import bpy

    if not bpy.app.background or not sys.platform.startswith("linux"):
        return True
    return egl_works()


def egl_works() -> bool:
    """Whether some EGL display can be initialised."""
    try:
        egl = ctypes.CDLL("libEGL.so.1")
    except OSError:
        return False
    pointer = ctypes.c_void_p
    egl.eglGetProcAddress.restype, egl.eglGetProcAddress.argtypes = pointer, [ctypes.c_char_p]
    egl.eglGetDisplay.restype, egl.eglGetDisplay.argtypes = pointer, [pointer]
    egl.eglInitialize.restype, egl.eglInitialize.argtypes = ctypes.c_uint, [pointer, pointer, pointer]
    displays = [egl.eglGetDisplay(None)]
    address = egl.eglGetProcAddress(b"eglGetPlatformDisplayEXT")
    if address:
        prototype = ctypes.CFUNCTYPE(pointer, ctypes.c_uint, pointer, pointer)
        for platform in (EGL_PLATFORM_SURFACELESS, EGL_PLATFORM_DEVICE):
            displays.append(prototype(address)(platform, None, None))
    return any(display and egl.eglInitialize(display, None, None) for display in displays)
