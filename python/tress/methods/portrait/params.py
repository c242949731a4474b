"""The parameters of all stages in one record."""

from dataclasses import dataclass, field

from tress.base.params import Params, param
from tress.head.fit import FitParams
from tress.image.layers import LayerParams
from tress.image.matte import MatteParams
from tress.image.orient import OrientParams
from tress.image.trace import TraceParams
from tress.methods.portrait.color import ColorParams
from tress.methods.portrait.depth import DepthParams
from tress.methods.portrait.grow import GrowParams
from tress.methods.portrait.volume import VolumeParams


@dataclass(frozen=True)
class PortraitParams(Params):
    """Parameters of a reconstruction: one field a stage, named like the stage, and the seed of all that is random.

    Orientation and tracing begin with their presets for photographs; `OrientParams()` and `TraceParams()` are the
    paper's own.
    """

    seed: int = param(0, low=0, high=2**63 - 1, doc="Seed of all that is random.")
    head: FitParams = field(default_factory=FitParams)
    layers: LayerParams = field(default_factory=LayerParams)
    matte: MatteParams = field(default_factory=MatteParams)
    orientation: OrientParams = field(default_factory=OrientParams.robust)
    trace: TraceParams = field(default_factory=TraceParams.robust)
    depth: DepthParams = field(default_factory=DepthParams)
    volume: VolumeParams = field(default_factory=VolumeParams)
    strands: GrowParams = field(default_factory=GrowParams)
    color: ColorParams = field(default_factory=ColorParams)
