"""The list of edits: a new one is its file and its line here. Each is a pure function from a `Document` to a `Diff`."""

from collections.abc import Callable, Mapping

from tress.edit.add import add
from tress.edit.attach import attach
from tress.edit.comb import comb
from tress.edit.cover import cover
from tress.edit.delete import delete
from tress.edit.detach import detach
from tress.edit.displace import displace
from tress.edit.duplicate import duplicate
from tress.edit.group import group
from tress.edit.hide import hide
from tress.edit.keyframe import set_keyframes
from tress.edit.knots import set_knots
from tress.edit.layer import layer
from tress.edit.lock import lock
from tress.edit.mirror import mirror
from tress.edit.push_out import push_out
from tress.edit.recolour import recolour
from tress.edit.refine import refine
from tress.edit.transform import transform
from tress.edit.ungroup import ungroup
from tress.edit.weights import set_weights
from tress.model.diff import Diff

EDITS: Mapping[str, Callable[..., Diff]] = {
    edit.__name__: edit
    for edit in (
        add,
        attach,
        comb,
        cover,
        delete,
        detach,
        displace,
        duplicate,
        group,
        hide,
        layer,
        lock,
        mirror,
        push_out,
        recolour,
        refine,
        set_keyframes,
        set_knots,
        set_weights,
        transform,
        ungroup,
    )
}
