// Draws two meshes of balsam with a material: the properties are set by measure.py.
import QtQuick
import QtQuick3D

View3D {
    id: view
    property var job
    property real part: 0
    camera: PerspectiveCamera {
        z: view.job.eye
        fieldOfView: view.job.field
        clipNear: 0.1
        clipFar: 100
    }
    environment: SceneEnvironment {
        backgroundMode: SceneEnvironment.Color
        clearColor: "black"
        tonemapMode: view.job.lit ? SceneEnvironment.TonemapModeLinear : SceneEnvironment.TonemapModeNone
        debugSettings: DebugSettings {
            materialOverride: view.job.normals ? DebugSettings.Normals : DebugSettings.None
        }
    }
    DirectionalLight {
        eulerRotation: Qt.vector3d(-38, -40, 0)
        ambientColor: Qt.rgba(0.1, 0.1, 0.1, 1)
    }
    component Ring: Model {
        id: model
        property string map
        property real x0
        property CustomMaterial measured: CotanMaterial {
            property real part: view.part
            normalMap: map_
            fragmentShader: view.job.shader
            cullMode: view.job.name === "back" ? CustomMaterial.NoCulling : CustomMaterial.BackFaceCulling
        }
        property PrincipledMaterial own: PrincipledMaterial {
            roughness: 0.5
            normalMap: map_
        }
        Texture {
            id: map_
            source: model.map
            generateMipmaps: true
            mipFilter: Texture.Linear
        }
        x: x0
        rotation: Qt.quaternion(...view.job.rotation)
        materials: [view.job.shader ? measured : own]
    }
    Ring { source: view.job.folder + "/meshes/meshes_0__mesh.mesh"; map: view.job.maps[0]; x0: -1.2 }
    Ring { source: view.job.folder + "/meshes/meshes_1__mesh.mesh"; map: view.job.maps[1]; x0: 1.2 }
}
