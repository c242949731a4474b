"""Laws of every record type: USD maps it without loss, it can be pickled, and a list says that it is there."""

import inspect
import pickle

import documents
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tress.io.usd.mapping import prim_of, record_of
from tress.model.atlas import Atlas
from tress.model.attachment import Attachment
from tress.model.camera import Camera
from tress.model.group import Group
from tress.model.head import Head
from tress.model.keyframes import Keyframes
from tress.model.mesh import Mesh
from tress.model.recipe import Recipe
from tress.model.records import RECORDS
from tress.model.strands import Strands
from tress.model.strip import Strip
from tress.model.texture import Texture

FIXTURES = {
    Strands: documents.strands(),
    Mesh: documents.meshes(),
    Texture: documents.textures(),
    Head: documents.heads(),
    Camera: documents.cameras(),
    Recipe: documents.recipes(),
    Strip: documents.strips(),
    Attachment: documents.attachments(),
    Group: st.builds(Group, parent=documents.TEXT, hidden=st.booleans(), locked=st.booleans()),
    Keyframes: documents.keyframes(),
    Atlas: documents.atlases(),
}
LAX = settings(max_examples=25, deadline=None, suppress_health_check=list(HealthCheck))

every_record = pytest.mark.parametrize("kind", RECORDS, ids=lambda kind: kind.__name__)


@every_record
def test_every_record_has_a_fixture_and_says_what_it_is(kind):
    assert kind in FIXTURES
    assert inspect.getdoc(kind)


@every_record
def test_prims_lose_nothing(kind):
    @LAX
    @given(FIXTURES[kind])
    def law(record):
        assert record_of(prim_of("name", record)) == record

    law()


@every_record
def test_pickles_lose_nothing(kind):
    @LAX
    @given(FIXTURES[kind])
    def law(record):
        assert pickle.loads(pickle.dumps(record)) == record

    law()
