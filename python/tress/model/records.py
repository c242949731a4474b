"""The list of record types: a new one is its file and its line here."""

from tress.model.atlas import Atlas
from tress.model.attachment import Attachment
from tress.model.camera import Camera
from tress.model.group import Group
from tress.model.head import Head
from tress.model.keyframes import Keyframes
from tress.model.mesh import Mesh
from tress.model.recipe import Recipe
from tress.model.record import Record
from tress.model.strands import Strands
from tress.model.strip import Strip
from tress.model.texture import Texture

RECORDS: tuple[type[Record], ...] = (
    Strands,
    Mesh,
    Texture,
    Head,
    Camera,
    Recipe,
    Strip,
    Attachment,
    Group,
    Keyframes,
    Atlas,
)
