# SPDX-License-Identifier: Apache-2.0
"""Images that come as arrays."""

import os

from .errors import UserError


def is_array(image) -> bool:
    """Whether this is an image, or several, and no path."""
    return image is not None and not isinstance(image, (str, bytes, os.PathLike))


def pairs(left, right):
    """The pairs of a sequence, as arrays that the libraries can read where they are."""
    for side, images in (("left", left), ("right", right)):
        if not is_array(images):
            raise UserError(f"{side} is {'missing' if images is None else 'a path'}, but the other image is an array")
    lefts, rights = _arrays("left", left), _arrays("right", right)
    if len(lefts) != len(rights):
        raise UserError(f"left has {len(lefts)} images, right {len(rights)}: a sequence needs pairs")
    if not lefts:
        raise UserError("left and right hold no image")
    return list(zip(lefts, rights))


def _arrays(side, images):
    if isinstance(images, (list, tuple)):
        return [_array(f"{side}[{i}]", image) for i, image in enumerate(images)]
    return [_array(side, images)]


def _array(name, image):
    import numpy

    array = numpy.asarray(image)
    if array.dtype.kind != "u" or array.dtype.itemsize > 2:
        raise UserError(f"{name} is an array of {array.dtype}, expected uint8 or uint16")
    if array.ndim not in (2, 3) or (array.ndim == 3 and array.shape[2] not in (3, 4)) or array.size == 0:
        raise UserError(f"{name} has the shape {array.shape}, expected (rows, columns), or (rows, columns, 3) for RGB, 4 for RGBA")
    return numpy.ascontiguousarray(array, array.dtype.newbyteorder("="))
