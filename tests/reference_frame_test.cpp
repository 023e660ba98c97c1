// Frames and normals of the reference renderer.
#include "reference_scene.hpp"

using namespace cotan;
using namespace cotan::testing;

namespace {

// A patch seen at an angle, with uv stretched 2:1 and sheared.
const Patch kSheared{{-1.2, 0.9, -0.4}, {2.4, 0.2, 0.7}, {0.4, -1.3, 0.6}};

// Tolerance for float differences: positions of magnitude 4 are rounded to 2.4e-7 and their differences are about 0.04,
// which gives 6e-6 radians; ten times that.
constexpr double kDegrees = 4e-3;

constexpr glm::ivec3 kTexel{170, 90, 220};
const glm::dvec3 kDecoded{42.0 / 127, -38.0 / 127, 92.0 / 127};

// A mesh with every attribute that a frame may read, from the patch's own gradients.
Mesh fullMesh(const Patch& patch)
{
    Mesh mesh = meshOf(patch);
    for (std::size_t i = 0; i < 4; ++i) {
        mesh.cotangentsU.push_back(glm::vec3(patch.gradU()));
        mesh.cotangentsV.push_back(glm::vec3(patch.gradV()));
        // glTF: cross(n, t) * w points up the image, against +v.
        glm::dvec3 t = glm::normalize(patch.alongU);
        double w = glm::dot(glm::cross(patch.normal(), t), patch.alongV) < 0 ? 1 : -1;
        mesh.tangents.push_back(glm::vec4(t, w));
    }
    return mesh;
}

glm::mat4 scaling(float x, float y, float z)
{
    glm::mat4 m(1);
    m[0][0] = x;
    m[1][1] = y;
    m[2][2] = z;
    return m;
}

} // namespace

TEST(ReferenceFrame, flatNormalMapChangesNothing)
{
    Scene scene = sceneOf(fullMesh(kSheared));
    addNormalMap(scene, {128, 128, 255});
    for (const FrameInfo& f : frames()) {
        int count = forCovered(rendered(scene, viewOf(Output::normal, f.frame)), [&](int, int, glm::vec4 value) {
            ASSERT_LT(degreesBetween(glm::vec3(value), kSheared.normal()), 1e-4) << f.name;
        });
        EXPECT_GT(count, 300);
    }
}

TEST(ReferenceFrame, tiltedTexelFollowsTheGradientsOfAShearedPatch)
{
    Scene scene = sceneOf(fullMesh(kSheared));
    addNormalMap(scene, kTexel);
    glm::dvec3 expected = kSheared.perturbed(kDecoded);
    for (Frame frame : {Frame::cotangent, Frame::exact, Frame::smooth}) {
        int count = forCovered(rendered(scene, viewOf(Output::normal, frame)), [&](int, int, glm::vec4 value) {
            ASSERT_LT(degreesBetween(glm::vec3(value), expected), kDegrees) << name(frame);
        });
        EXPECT_GT(count, 300);
    }
}

TEST(ReferenceFrame, allFramesAgreeOnASquarePatchFacingTheCamera)
{
    Scene scene = sceneOf(fullMesh(kSquare));
    addNormalMap(scene, kTexel);
    glm::dvec3 expected = kSquare.perturbed(kDecoded);
    for (const FrameInfo& f : frames()) {
        if (f.frame == Frame::gradient)
            continue; // bump height in world units: differs by the size of the patch
        View view = viewOf(Output::normal, f.frame);
        // `cotangent-2013` is correct only if the rows of the raster run upward.
        view.rowsUpward = f.frame == Frame::cotangent2013;
        int count = forCovered(rendered(scene, view), [&](int, int, glm::vec4 value) {
            ASSERT_LT(degreesBetween(glm::vec3(value), expected), kDegrees) << f.name;
        });
        EXPECT_GT(count, 300);
    }
}

TEST(ReferenceFrame, gradientHasTheLengthOfTheTrueGradient)
{
    Image t = rendered(sceneOf(fullMesh(kSheared)), viewOf(Output::tangent, Frame::gradient));
    Image b = rendered(sceneOf(fullMesh(kSheared)), viewOf(Output::bitangent, Frame::gradient));
    // Relative rounding of float differences, as above.
    EXPECT_LT(glm::length(glm::dvec3(pixelOf(t, 32, 32)) - kSheared.gradU()), 1e-4);
    EXPECT_LT(glm::length(glm::dvec3(pixelOf(b, 32, 32)) - kSheared.gradV()), 1e-4);
}

TEST(ReferenceFrame, greenUpEqualsReversedGreen)
{
    Scene along = sceneOf(fullMesh(kSheared)), against = along;
    addNormalMap(along, kTexel);
    addNormalMap(against, {kTexel.x, 256 - kTexel.y, kTexel.z});
    against.materials[0].normalFormat.greenUp = true;
    Image other = rendered(against, viewOf(Output::normal));
    forCovered(rendered(along, viewOf(Output::normal)), [&](int x, int y, glm::vec4 value) {
        // Decoding rounds the two bytes to opposite numbers, up to a few units of 1e-7.
        ASSERT_LT(degreesBetween(glm::vec3(value), glm::vec3(pixelOf(other, x, y))), 1e-4);
    });
}

TEST(ReferenceFrame, rowsUpwardReversesOnlyTheFrameOf2013)
{
    Scene scene = sceneOf(meshOf(kSheared));
    addNormalMap(scene, kTexel);
    for (Frame frame : {Frame::cotangent, Frame::cotangent2013}) {
        View down = viewOf(Output::tangent, frame), up = down;
        up.rowsUpward = true;
        Image a = rendered(scene, down), b = rendered(scene, up);
        double sign = frame == Frame::cotangent ? 1 : -1;
        int count = forCovered(a, [&](int x, int y, glm::vec4 value) {
            glm::vec4 other = pixelOf(b, x, y);
            if (other.w == 0)
                return; // on the border, where the edge rule depends on the raster
            ASSERT_LT(degreesBetween(glm::vec3(value), sign * glm::dvec3(other)), kDegrees);
        });
        EXPECT_GT(count, 300);
    }
    View down = viewOf(Output::normal), up = down;
    up.rowsUpward = true;
    Image a = rendered(scene, down), b = rendered(scene, up);
    forCovered(a, [&](int x, int y, glm::vec4 value) {
        glm::vec4 other = pixelOf(b, x, y);
        ASSERT_LT(other.w == 0 ? 0 : degreesBetween(glm::vec3(value), glm::vec3(other)), kDegrees);
    });
}

// Section "signs" of docs/explanation/theory.md: handedness of the world (reversed by a mirroring instance), direction
// of the raster's rows, mirrored uv, and the visible side with the normal as stored or flipped towards the viewer: 24
// combinations.
TEST(ReferenceFrame, tangentsFollowGradientsInAll24SignCombinations)
{
    struct Side {
        bool back, normalToViewer;
    };
    for (bool mirroredWorld : {false, true})
        for (bool rowsUpward : {false, true})
            for (bool mirroredUv : {false, true})
                for (Side side : {Side{false, true}, Side{true, false}, Side{true, true}}) {
                    Patch patch = kSheared;
                    Mesh mesh = meshOf(patch);
                    glm::dvec3 gradU = patch.gradU(), gradV = patch.gradV();
                    if (mirroredUv) {
                        for (glm::vec2& uv : mesh.texcoords[0])
                            uv.x = 1 - uv.x;
                        gradU = -gradU;
                    }
                    if (side.back && side.normalToViewer)
                        for (glm::vec3& n : mesh.normals)
                            n = -n;
                    double mirror = mirroredWorld ? -1 : 1;
                    gradU.x *= mirror;
                    gradV.x *= mirror;
                    Scene scene = sceneOf(mesh, scaling(float(mirror), 1, 1));
                    scene.materials[0].doubleSided = true;
                    View view = viewOf(Output::tangent);
                    view.rowsUpward = rowsUpward;
                    if (side.back)
                        view.camera.eye.z = -4;
                    auto check = [&](glm::dvec3 gradient) {
                        int count = forCovered(rendered(scene, view), [&](int, int, glm::vec4 value) {
                            ASSERT_LT(degreesBetween(glm::vec3(value), gradient), kDegrees)
                                << mirroredWorld << rowsUpward << mirroredUv << side.back << side.normalToViewer;
                        });
                        EXPECT_GT(count, 300);
                    };
                    check(gradU);
                    view.output = Output::bitangent;
                    check(gradV);
                }
}

TEST(ReferenceFrame, mirroredInstanceKeepsTangentsAlongTheGradients)
{
    // Gradients are covectors: diag(s) scales them by 1/s. Stored tangents are vectors, correct for the orthonormal
    // frames as long as uv stay square.
    Scene scene = sceneOf(fullMesh(kSquare), scaling(-1, 1, 1));
    for (Frame frame :
         {Frame::cotangent, Frame::exact, Frame::smooth, Frame::vertex, Frame::mikktspace, Frame::orthonormal}) {
        glm::vec4 t = pixelOf(rendered(scene, viewOf(Output::tangent, frame)), 32, 32);
        glm::vec4 b = pixelOf(rendered(scene, viewOf(Output::bitangent, frame)), 32, 32);
        EXPECT_LT(degreesBetween(glm::vec3(t), {-1, 0, 0}), kDegrees) << name(frame);
        EXPECT_LT(degreesBetween(glm::vec3(b), {0, -1, 0}), kDegrees) << name(frame);
    }
}

TEST(ReferenceFrame, nonUniformScaleMovesGradientsAsCovectors)
{
    glm::dvec3 s(0.5, 1.5, -2);
    Patch moved = kSheared;
    for (glm::dvec3* v : {&moved.origin, &moved.alongU, &moved.alongV})
        *v *= s;
    glm::dvec3 normal = glm::normalize(kSheared.normal() / s);
    glm::dvec3 expectedT = glm::normalize(moved.gradU());
    Scene scene = sceneOf(fullMesh(kSheared), scaling(0.5f, 1.5f, -2));
    scene.materials[0].doubleSided = true;
    for (Frame frame : {Frame::cotangent, Frame::exact, Frame::smooth}) {
        View view = viewOf(Output::tangent, frame);
        if (normal.z < 0)
            view.camera.eye.z = -4;
        int count = forCovered(rendered(scene, view), [&](int, int, glm::vec4 value) {
            ASSERT_LT(degreesBetween(glm::vec3(value), expectedT), kDegrees) << name(frame);
        });
        EXPECT_GT(count, 100);
        view.output = Output::normal;
        forCovered(rendered(scene, view),
                   [&](int, int, glm::vec4 value) { ASSERT_LT(degreesBetween(glm::vec3(value), normal), kDegrees); });
    }
}

TEST(ReferenceFrame, mirroringInstanceKeepsFrontFaces)
{
    Image image = rendered(sceneOf(meshOf(kSquare), scaling(-1, 1, 1)), viewOf(Output::normal));
    EXPECT_GT(forCovered(image, [](int, int, glm::vec4) {}), 300);
}

TEST(ReferenceFrame, backFacesAreCulledUnlessDoubleSided)
{
    Scene scene = sceneOf(meshOf(kSquare));
    addNormalMap(scene, kTexel);
    View view = viewOf(Output::normal);
    view.camera.eye.z = -4;
    EXPECT_EQ(forCovered(rendered(scene, view), [](int, int, glm::vec4) {}), 0);
    scene.materials[0].doubleSided = true;
    // The back of a thin sheet: the final normal, negated.
    glm::dvec3 expected = -kSquare.perturbed(kDecoded);
    int count = forCovered(rendered(scene, view), [&](int, int, glm::vec4 value) {
        ASSERT_LT(degreesBetween(glm::vec3(value), expected), kDegrees);
    });
    EXPECT_GT(count, 300);
}

TEST(ReferenceFrame, disabledNormalMapsShowTheInterpolatedNormal)
{
    Scene scene = sceneOf(meshOf(kSheared));
    addNormalMap(scene, kTexel);
    View view = viewOf(Output::normal);
    view.normalMaps = false;
    forCovered(rendered(scene, view), [&](int, int, glm::vec4 value) {
        ASSERT_LT(degreesBetween(glm::vec3(value), kSheared.normal()), 1e-4);
    });
}

TEST(ReferenceFrame, normalScaleMultipliesTheSlopes)
{
    Scene scene = sceneOf(meshOf(kSquare));
    addNormalMap(scene, kTexel);
    scene.materials[0].normalScale = 0.5f;
    glm::dvec3 expected = kSquare.perturbed(kDecoded * glm::dvec3(0.5, 0.5, 1));
    forCovered(rendered(scene, viewOf(Output::normal)),
               [&](int, int, glm::vec4 value) { ASSERT_LT(degreesBetween(glm::vec3(value), expected), kDegrees); });
}

TEST(ReferenceFrame, textureTransformRotatesTheFrame)
{
    // Coordinates rotated by 90 degrees: new u runs along old v, new v against old u.
    Scene scene = sceneOf(meshOf(kSquare));
    addNormalMap(scene, kTexel);
    scene.materials[0].normalMap.uRow = {0, 1, 0};
    scene.materials[0].normalMap.vRow = {-1, 0, 1};
    glm::dvec3 t = kSquare.gradV(), b = -kSquare.gradU();
    glm::dvec3 expected =
        glm::normalize(kSquare.normal() * kDecoded.z + (t * kDecoded.x + b * kDecoded.y) / glm::length(t));
    for (Frame frame : {Frame::cotangent, Frame::exact})
        forCovered(rendered(scene, viewOf(Output::normal, frame)),
                   [&](int, int, glm::vec4 value) { ASSERT_LT(degreesBetween(glm::vec3(value), expected), kDegrees); });
}

TEST(ReferenceFrame, secondUvSetIsUsedIfTheMapSelectsIt)
{
    Mesh mesh = meshOf(kSquare);
    mesh.texcoords[1] = mesh.texcoords[0];
    for (glm::vec2& uv : mesh.texcoords[1])
        uv = {uv.y, 1 - uv.x};
    Scene scene = sceneOf(mesh);
    scene.materials[0].normalMap.texcoord = 1;
    glm::vec4 t = pixelOf(rendered(scene, viewOf(Output::tangent)), 32, 32);
    EXPECT_LT(degreesBetween(glm::vec3(t), {0, -1, 0}), kDegrees);
}

TEST(ReferenceFrame, degenerateUvGiveTheInterpolatedNormal)
{
    for (int kind = 0; kind < 3; ++kind) {
        Mesh mesh = fullMesh(kSheared);
        if (kind == 0)
            for (glm::vec2& uv : mesh.texcoords[0])
                uv = {0.25f, 0.75f};
        if (kind == 1)
            mesh.texcoords[0].clear();
        if (kind == 2)
            for (glm::vec2& uv : mesh.texcoords[0])
                uv = glm::vec2(std::nanf(""));
        Scene scene = sceneOf(mesh);
        addNormalMap(scene, kTexel);
        for (Frame frame : {Frame::cotangent, Frame::orthonormal, Frame::gradient, Frame::exact}) {
            int count = forCovered(rendered(scene, viewOf(Output::normal, frame)), [&](int, int, glm::vec4 value) {
                ASSERT_LT(degreesBetween(glm::vec3(value), kSheared.normal()), 1e-4)
                    << name(frame) << ", kind " << kind;
            });
            EXPECT_GT(count, 300);
        }
    }
}

TEST(ReferenceFrame, vertexFramesWithoutAttributesAreRefused)
{
    Scene scene = sceneOf(meshOf(kSheared));
    addNormalMap(scene, kTexel);
    scene.meshes[0].name = "bare";
    for (const FrameInfo& f : frames()) {
        const auto image = renderReference(scene, viewOf(Output::normal, f.frame));
        ASSERT_EQ(bool(image), !readsVertices(f.frame)) << f.name;
        if (image)
            continue;
        EXPECT_EQ(image.error().kind, ErrorKind::usage);
        EXPECT_NE(image.error().message.find("'bare'"), std::string::npos) << image.error().message;
        EXPECT_NE(image.error().message.find(f.name), std::string::npos) << image.error().message;
    }
    scene.meshes[0].tangents.assign(scene.meshes[0].vertexCount(), {1, 0, 0, 1});
    EXPECT_TRUE(renderReference(scene, viewOf(Output::normal, Frame::vertex)));
    EXPECT_FALSE(renderReference(scene, viewOf(Output::normal, Frame::smooth)));
    scene.meshes[0].cotangentsU = scene.meshes[0].cotangentsV = scene.meshes[0].normals;
    EXPECT_TRUE(renderReference(scene, viewOf(Output::normal, Frame::smooth)));
}

TEST(ReferenceFrame, vertexFramesWithoutUvAreZero)
{
    Scene scene = sceneOf(meshOf(kSheared));
    scene.meshes[0].texcoords[0].clear();
    for (Frame frame : {Frame::smooth, Frame::vertex, Frame::mikktspace}) {
        glm::vec4 t = pixelOf(rendered(scene, viewOf(Output::tangent, frame)), 32, 32);
        EXPECT_EQ(t, glm::vec4(0, 0, 0, 1));
        glm::vec4 n = pixelOf(rendered(scene, viewOf(Output::normal, frame)), 32, 32);
        EXPECT_LT(degreesBetween(glm::vec3(n), kSheared.normal()), 1e-4);
    }
}

TEST(ReferenceFrame, precisionIsIndependentOfTheOrigin)
{
    // Positions are relative to the eye: a million units away the float matrix still represents sixteenths, and the
    // patch's own coordinates keep all their bits.
    glm::mat4 away(1);
    away[3] = {1048576, -1048576, 524288, 1};
    Scene scene = sceneOf(meshOf(kSheared), away);
    addNormalMap(scene, kTexel);
    View view = viewOf(Output::normal);
    view.camera.eye += glm::vec3(away[3]);
    view.camera.target += glm::vec3(away[3]);
    int count = forCovered(rendered(scene, view), [&](int, int, glm::vec4 value) {
        ASSERT_LT(degreesBetween(glm::vec3(value), kSheared.perturbed(kDecoded)), kDegrees);
    });
    EXPECT_GT(count, 300);
}
