# Draws the jobs of jobs.json in Qt Quick 3D: python3 measure.py, run by tests/engines/qtquick3d.py in the folder of all files.
# A job: the properties of Measure.qml, parts (how often it is drawn), out (raw RGB images of bytes, one for each part).
import json
import os
import pathlib
import sys
import time

from PySide6.QtCore import QUrl, qVersion
from PySide6.QtGui import QGuiApplication, QImage
from PySide6.QtQuick import QQuickView
from PySide6.QtQuick3D import QQuick3D

application = QGuiApplication(sys.argv)
QQuickView.setDefaultAlphaBuffer(False)


def grab(view):
    application.processEvents()
    image = view.grabWindow().convertToFormat(QImage.Format_RGB888)
    bits = bytes(image.constBits())
    return b"".join(bits[y * image.bytesPerLine() : y * image.bytesPerLine() + 3 * image.width()] for y in range(image.height()))


def settled(view):
    """An image that does not change any more: windows appear, and meshes and images are loaded, when they like."""
    last, same = b"", 0
    end = time.monotonic() + 20
    while time.monotonic() < end:
        image = grab(view)
        same = same + 1 if view.isExposed() and image == last and any(image) else 0
        if same == 3:
            return image
        last = image
        time.sleep(0.01)
    raise AssertionError(f"no image in 20 seconds: the window is {'' if view.isExposed() else 'not '}there, the image is {'not ' if any(last) else ''}black")


def draw(view, job):
    view.setSource(QUrl())
    view.setInitialProperties({"job": job})
    view.resize(job["width"], job["height"])
    view.setSource(QUrl.fromLocalFile(os.path.abspath("Measure.qml")))
    assert view.status() == QQuickView.Ready, [error.toString() for error in view.errors()]
    view.show()
    with open(job["out"], "wb") as file:
        for part in range(job["parts"]):
            view.rootObject().setProperty("part", float(part))
            application.processEvents()
            file.write(settled(view))
    print("drawn", view.rendererInterface().graphicsApi())


def main():
    view = QQuickView()
    view.setFormat(QQuick3D.idealSurfaceFormat(1))
    view.setResizeMode(QQuickView.SizeRootObjectToView)
    for job in json.loads(pathlib.Path("jobs.json").read_text()):
        draw(view, job)
    print("Qt", qVersion())
    print("DONE", flush=True)
    os._exit(0)


main()
