"""The three networks of the head, taken as they are out of MediaPipe's wheel."""

from pathlib import Path

from tools.assets.wheels import MEDIAPIPE, fetched, members

NETWORKS = {
    "face_detection_short_range.tflite": "mediapipe/modules/face_detection/face_detection_short_range.tflite",
    "face_landmark.tflite": "mediapipe/modules/face_landmark/face_landmark.tflite",
    "selfie_segmentation.tflite": "mediapipe/modules/selfie_segmentation/selfie_segmentation.tflite",
}


def write_networks(*, cache: Path, data: Path) -> dict[str, str]:
    """Writes the three `.tflite` files into `data`; returns for each the member of the wheel that it was."""
    contents = members(fetched(MEDIAPIPE, cache=cache), tuple(NETWORKS.values()))
    for name, member in NETWORKS.items():
        (data / name).write_bytes(contents[member])
    return {name: f"{MEDIAPIPE.name} {MEDIAPIPE.version}: {member}" for name, member in NETWORKS.items()}
