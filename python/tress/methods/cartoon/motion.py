"""Secondary motion of a cartoon hairdo: what hangs is simulated, what lies on the head is not."""

from tress.base.report import Report
from tress.dynamics.head_motion import HeadMotion, still
from tress.dynamics.params import HairParams
from tress.dynamics.simulate import simulate
from tress.kernel.dynamics import DynamicsParams
from tress.methods.cartoon.layer import CAP
from tress.methods.cartoon.tails import LYING
from tress.methods.strips.bald_document import HEAD
from tress.methods.strips.edited import edited
from tress.methods.strips.layers import HAIR
from tress.model.document import Document
from tress.model.group import Group
from tress.model.strips import strips_in

CLUMPS = HairParams(root_goal=0.85, tip_goal=0.12, held=3)
"""Clumps keep more of their shape than strands."""


def simulated(
    document: Document,
    *,
    head_motion: HeadMotion = still,
    hair: HairParams = CLUMPS,
    forces: DynamicsParams = DynamicsParams(),
    report: Report | None = None,
) -> Document:
    """The document with simulated keyframes for all clumps but those of the cap and those that lie between a hairline
    and a tie. Surfaces, and what they did, stay: they are the goal. Raises what `simulate` raises."""
    return edited(
        document,
        simulate,
        targets=hanging(document),
        hair=hair,
        forces=forces,
        surface=HEAD,
        head_motion=head_motion,
        report=report,
    )


def hanging(document: Document) -> list[str]:
    """The groups within `hair` whose clumps have a free end."""
    groups = {name for name, group in document.of_type(Group).items() if group.parent == HAIR}
    return sorted(name for name in groups if name != CAP and not name.startswith(LYING) and strips_in(document, name))
