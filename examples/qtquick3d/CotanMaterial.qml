// A material like PrincipledMaterial whose normal map needs no tangents. README.md says how to make its shader.
import QtQuick
import QtQuick3D

CustomMaterial {
    id: material
    property alias normalMap: normalInput.texture
    property alias baseColorMap: colorInput.texture
    property color baseColor: "white"
    property real metalness: 0
    property real roughness: 0.5
    readonly property bool hasBaseColorMap: baseColorMap !== null
    readonly property TextureInput normalTexture: TextureInput { id: normalInput }
    readonly property TextureInput baseColorTexture: TextureInput { id: colorInput }
    shadingMode: CustomMaterial.Shaded
    fragmentShader: "cotan_material.frag"
}
