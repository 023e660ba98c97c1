// Conversion of Assimp structures made by hand: each file format holds few of them, and no test file holds all.
#include <cmath>
#include <memory>
#include <numbers>

#include <assimp/camera.h>
#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>
#include <glm/geometric.hpp>

#include "assimp_convert.hpp"
#include "model_file.hpp"

namespace cotan {
namespace {

const float kNan = std::nanf("");

void lay(aiMaterial& material, aiTextureType type, const char* path, int uvSet = 0,
         aiTextureMapMode u = aiTextureMapMode_Wrap, aiTextureMapMode v = aiTextureMapMode_Wrap)
{
    const aiString name(path);
    const int modes[] = {int(u), int(v)};
    material.AddProperty(&name, AI_MATKEY_TEXTURE(type, 0));
    material.AddProperty(&uvSet, 1, AI_MATKEY_UVWSRC(type, 0));
    material.AddProperty(&modes[0], 1, AI_MATKEY_MAPPINGMODE_U(type, 0));
    material.AddProperty(&modes[1], 1, AI_MATKEY_MAPPINGMODE_V(type, 0));
}

class AssimpStructures : public ModelFile {
protected:
    Scene scene;

    Material materialOf(const aiMaterial& source)
    {
        const LoadLimits limits;
        const auto canonical = std::filesystem::canonical(folder);
        TextureReader textures(scene, canonical, limits);
        return convertMaterial(source, textures, scene);
    }
};

// Each texture of Material is read from its list of Assimp texture types; the first type present wins.
TEST_F(AssimpStructures, theFirstTextureTypePresentWins)
{
    for (const char* const name : {"a.png", "b.png", "c.png"})
        paint(name, {10, 20, 200});
    struct Row {
        std::vector<aiTextureType> types;
        Texture Material::*texture;
    };
    const std::vector<Row> rows = {
        {{aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE}, &Material::baseColorMap},
        {{aiTextureType_DIFFUSE_ROUGHNESS}, &Material::metallicRoughnessMap},
        {{aiTextureType_METALNESS}, &Material::metallicRoughnessMap},
        {{aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA, aiTextureType_HEIGHT}, &Material::normalMap},
        {{aiTextureType_EMISSION_COLOR, aiTextureType_EMISSIVE}, &Material::emissiveMap},
        {{aiTextureType_AMBIENT_OCCLUSION}, &Material::occlusionMap}};
    const char* const names[] = {"a.png", "b.png", "c.png"};
    for (const Row& row : rows)
        for (std::size_t first = 0; first < row.types.size(); ++first) {
            scene = {};
            aiMaterial source;
            for (std::size_t i = row.types.size(); i-- > first;)
                lay(source, row.types[i], names[i], 1, aiTextureMapMode_Mirror, aiTextureMapMode_Clamp);
            const Material m = materialOf(source);
            const Texture& found = m.*row.texture;
            ASSERT_TRUE(found.present()) << row.types[first];
            EXPECT_EQ(found.texcoord, 1);
            EXPECT_EQ(found.sampler.wrapU, Wrap::mirror);
            EXPECT_EQ(found.sampler.wrapV, Wrap::clamp);
            if (row.texture != &Material::metallicRoughnessMap) {
                EXPECT_TRUE(scene.images.at(std::size_t(found.image)).name.ends_with(names[first]));
                EXPECT_EQ(scene.images.size(), 1u); // the others are not read
            }
            for (Texture Material::*other : {&Material::baseColorMap, &Material::metallicRoughnessMap,
                                             &Material::normalMap, &Material::emissiveMap, &Material::occlusionMap})
                EXPECT_EQ((m.*other).present(), other == row.texture) << row.types[first];
            EXPECT_EQ(m.emissive, glm::vec3(row.texture == &Material::emissiveMap ? 1.0f : 0.0f));
            EXPECT_TRUE(scene.warnings.empty());
        }
    // An empty path counts as no texture. A uv set beyond the second is replaced by the first.
    aiMaterial source;
    lay(source, aiTextureType_BASE_COLOR, "");
    lay(source, aiTextureType_DIFFUSE, "b.png", 2, aiTextureMapMode_Decal, aiTextureMapMode_Wrap);
    const Texture color = materialOf(source).baseColorMap;
    EXPECT_TRUE(color.present());
    EXPECT_EQ(color.texcoord, 0);
    EXPECT_EQ(color.sampler.wrapU, Wrap::clamp);
    EXPECT_EQ(color.sampler.wrapV, Wrap::repeat);
    aiMaterial pierced;
    lay(pierced, aiTextureType_DIFFUSE, "a.png");
    lay(pierced, aiTextureType_OPACITY, "a.png");
    EXPECT_EQ(materialOf(pierced).alphaMode, AlphaMode::mask);
}

TEST_F(AssimpStructures, onlyNumericMaterialPropertiesAreRead)
{
    aiMaterial source;
    const aiString name("paint");
    const aiColor3D diffuse(0.1f, 0.2f, 0.3f), base(0.4f, -0.5f, 2), light(0.25f, 3, -1);
    const float opacity = 0.5f, exponent = 30, roughness = 0.25f, metallic = 0.75f;
    EXPECT_EQ(materialOf(source).name, "unnamed");
    EXPECT_EQ(materialOf(source).baseColor, glm::vec4(0.8f, 0.8f, 0.8f, 1));
    EXPECT_EQ(materialOf(source).metallic, 0);
    EXPECT_EQ(materialOf(source).alphaMode, AlphaMode::opaque);
    source.AddProperty(&name, AI_MATKEY_NAME);
    source.AddProperty(&diffuse, 1, AI_MATKEY_COLOR_DIFFUSE);
    EXPECT_EQ(materialOf(source).name, "paint");
    EXPECT_EQ(materialOf(source).baseColor, glm::vec4(0.1f, 0.2f, 0.3f, 1));
    source.AddProperty(&base, 1, AI_MATKEY_BASE_COLOR);
    source.AddProperty(&opacity, 1, AI_MATKEY_OPACITY);
    source.AddProperty(&exponent, 1, AI_MATKEY_SHININESS);
    source.AddProperty(&light, 1, AI_MATKEY_COLOR_EMISSIVE);
    Material m = materialOf(source);
    EXPECT_EQ(m.baseColor, glm::vec4(0.4f, 0, 2, 0.5f)); // negative values become 0
    EXPECT_EQ(m.emissive, glm::vec3(0.25f, 3, 0));
    EXPECT_EQ(m.alphaMode, AlphaMode::blend);
    EXPECT_NEAR(m.roughness, std::pow(2.0 / 32, 0.25), 1e-6);
    source.AddProperty(&roughness, 1, AI_MATKEY_ROUGHNESS_FACTOR);
    source.AddProperty(&metallic, 1, AI_MATKEY_METALLIC_FACTOR);
    m = materialOf(source);
    EXPECT_EQ(m.roughness, 0.25f);
    EXPECT_EQ(m.metallic, 0.75f);
    EXPECT_TRUE(m.doubleSided);
    aiMaterial odd;
    const aiColor3D half(1, kNan, 1);
    odd.AddProperty(&half, 1, AI_MATKEY_BASE_COLOR);
    odd.AddProperty(&diffuse, 1, AI_MATKEY_COLOR_DIFFUSE);
    odd.AddProperty(&kNan, 1, AI_MATKEY_OPACITY);
    odd.AddProperty(&kNan, 1, AI_MATKEY_ROUGHNESS_FACTOR);
    m = materialOf(odd);
    EXPECT_EQ(m.baseColor, glm::vec4(0.1f, 0.2f, 0.3f, 1));
    EXPECT_EQ(m.roughness, 0.7f);
}

// Two triangles over four corners, with a line and a point between them.
std::unique_ptr<aiMesh> twoTriangles()
{
    auto mesh = std::make_unique<aiMesh>();
    mesh->mName = "two";
    mesh->mNumVertices = 4;
    mesh->mVertices = new aiVector3D[4]{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 1}};
    const std::vector<std::vector<unsigned>> faces = {{0, 1, 2}, {1, 2}, {3}, {0, 2, 3}};
    mesh->mNumFaces = unsigned(faces.size());
    mesh->mFaces = new aiFace[faces.size()];
    for (std::size_t i = 0; i < faces.size(); ++i) {
        mesh->mFaces[i].mNumIndices = unsigned(faces[i].size());
        mesh->mFaces[i].mIndices = new unsigned[faces[i].size()];
        std::copy(faces[i].begin(), faces[i].end(), mesh->mFaces[i].mIndices);
    }
    return mesh;
}

std::string faultOf(const aiMesh& mesh)
{
    Scene scene;
    try {
        convertMesh(mesh, false, scene);
    } catch (const Error& error) {
        return error.message;
    }
    return "";
}

TEST_F(AssimpStructures, meshesKeepTheirTrianglesAndWarnAboutNonFiniteValues)
{
    const auto mesh = twoTriangles();
    const auto corner = [&](const std::vector<glm::vec2>& uv) {
        auto* made = new aiVector3D[4];
        for (std::size_t i = 0; i < 4; ++i)
            made[i] = {uv[i].x, uv[i].y, 0};
        return made;
    };
    mesh->mTextureCoords[0] = corner({{0, 0.25f}, {1, kNan}, {-kNan, 1}, {0.5f, 1}});
    mesh->mTextureCoords[1] = corner({{0, 0}, {3, 0}, {3, 4}, {0, 4}});
    mesh->mColors[0] = new aiColor4D[4]{{1, 0.5f, 0, 0.25f}, {2, -1, kNan, kNan}, {0, 0, 1, 2}, {0, 1, 0, -1}};
    mesh->mNormals = new aiVector3D[4]{{0, 0, 2}, {0, 0, 3}, {0, 0, 4}, {0, 0.6f, 0.8f}};
    const Mesh found = convertMesh(*mesh, false, scene);
    EXPECT_EQ(found.name, "two");
    ASSERT_EQ(found.triangleCount(), 2u);
    std::vector<glm::vec3> corners;
    for (const std::uint32_t i : found.indices)
        corners.push_back(found.positions[i]);
    EXPECT_EQ(corners, (std::vector<glm::vec3>{{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 0, 0}, {2, 3, 0}, {0, 3, 1}}));
    const auto first = found.indices[0], second = found.indices[1], third = found.indices[2], last = found.indices[5];
    EXPECT_EQ(found.texcoords[0][first], glm::vec2(0, 0.75f)); // v points down
    EXPECT_EQ(found.texcoords[0][second], glm::vec2(0));
    EXPECT_EQ(found.texcoords[0][third], glm::vec2(0));
    EXPECT_EQ(found.texcoords[0][last], glm::vec2(0.5f, 0));
    EXPECT_EQ(found.texcoords[1][third], glm::vec2(3, -3));
    EXPECT_EQ(scene.warnings, std::vector<std::string>{"mesh two: 2 texture coordinates are not finite; set to 0"});
    EXPECT_NEAR(found.colors[first].y, std::pow((0.5 + 0.055) / 1.055, 2.4), 1e-6); // IEC 61966-2-1
    EXPECT_EQ(found.colors[first].w, 0.25f);                                        // alpha is linear
    EXPECT_EQ(found.colors[second], glm::vec4(1, 0, 0, 1));
    EXPECT_EQ(found.colors[third], glm::vec4(0, 0, 1, 1));
    EXPECT_EQ(found.colors[last], glm::vec4(0, 1, 0, 0));
    EXPECT_EQ(found.normals[second], glm::vec3(0, 0, 1));
    EXPECT_NEAR(found.normals[last].y, 0.6, 1e-6);
    const Mesh flat = convertMesh(*mesh, true, scene); // normals of triangles; they are less than 60 degrees apart
    EXPECT_NE(flat.normals[flat.indices[5]].y, found.normals[last].y);
    mesh->mNormals[2] = {0, 0, 0};
    scene.warnings.clear();
    convertMesh(*mesh, false, scene);
    EXPECT_EQ(scene.warnings.back(), "mesh two: some normals are zero or not finite; all are regenerated");
    EXPECT_EQ(scene.warnings.size(), 2u);

    mesh->mName = "";
    EXPECT_EQ(convertMesh(*mesh, false, scene).name, "unnamed");
    mesh->mFaces[3].mIndices[1] = 4;
    EXPECT_EQ(faultOf(*mesh), "mesh unnamed: triangle 3: expected an index below 4, found 4");
    mesh->mFaces[3].mIndices[1] = 3;
    EXPECT_EQ(faultOf(*mesh), "");
    mesh->mVertices[3] = {1, kNan, 2};
    EXPECT_EQ(faultOf(*mesh), "mesh unnamed: position 3: expected finite numbers, found 1 nan 2");
    mesh->mNumFaces = 0;
    EXPECT_TRUE(convertMesh(*mesh, false, scene).positions.empty());
}

TEST_F(AssimpStructures, nodesPlaceMeshesAndCamerasUpToALimit)
{
    aiScene source; // owns what it points to
    auto* root = source.mRootNode = new aiNode("root");
    auto* left = new aiNode("left");
    auto* right = new aiNode("right");
    aiMatrix4x4::Translation({1, 2, 3}, root->mTransformation);
    aiMatrix4x4::Translation({10, 20, 30}, right->mTransformation);
    aiNode* children[] = {left, right};
    root->addChildren(2, children);
    right->mNumMeshes = 4;
    right->mMeshes = new unsigned[4]{1, 0, 7, 2}; // mesh 0 was dropped, mesh 7 does not exist
    left->mNumMeshes = 1;
    left->mMeshes = new unsigned[1]{2};
    source.mNumCameras = 2;
    source.mCameras = new aiCamera* [2] { new aiCamera, new aiCamera };
    aiCamera& camera = *source.mCameras[0];
    camera.mName = "right";
    camera.mPosition = {0, 0, 5};
    camera.mLookAt = {0, 0, -2};
    camera.mUp = {0, 3, 0};
    camera.mHorizontalFOV = 1;
    camera.mAspect = 2;
    source.mCameras[1]->mName = "nobody";
    convertNodes(source, {-1, 0, 1}, {}, scene);
    ASSERT_EQ(scene.instances.size(), 3u);
    EXPECT_EQ(scene.instances[0].name, "left");
    EXPECT_EQ(scene.instances[0].mesh, 1);
    EXPECT_EQ(scene.instances[0].toWorld[3], glm::vec4(1, 2, 3, 1));
    EXPECT_EQ(scene.instances[1].name, "right");
    EXPECT_EQ(scene.instances[1].mesh, 0);
    EXPECT_EQ(scene.instances[1].toWorld[3], glm::vec4(11, 22, 33, 1));
    EXPECT_EQ(scene.instances[2].mesh, 1);
    ASSERT_EQ(scene.cameras.size(), 1u);
    EXPECT_EQ(scene.cameras[0].name, "right");
    EXPECT_EQ(scene.cameras[0].eye, glm::vec3(11, 22, 38));
    EXPECT_EQ(scene.cameras[0].target, glm::vec3(11, 22, 36));
    EXPECT_EQ(scene.cameras[0].up, glm::vec3(0, 3, 0));
    EXPECT_NEAR(scene.cameras[0].verticalFieldOfView, 2 * std::atan(std::tan(0.5) / 2), 1e-6);
    EXPECT_FALSE(scene.cameras[0].orthographic);

    const auto again = [&](std::size_t nodes = 1000) -> std::string {
        scene = {};
        LoadLimits limits;
        limits.nodes = nodes;
        try {
            convertNodes(source, {-1, 0, 1}, limits, scene);
        } catch (const Error& error) {
            return error.message;
        }
        return "";
    };
    camera.mOrthographicWidth = 6; // Assimp stores half the width
    camera.mAspect = 0;            // unknown: 4:3 is assumed
    EXPECT_EQ(again(), "");
    EXPECT_TRUE(scene.cameras[0].orthographic);
    EXPECT_NEAR(scene.cameras[0].verticalExtent, 2 * 6 / (4.0 / 3), 1e-5);
    EXPECT_NEAR(scene.cameras[0].verticalFieldOfView, 2 * std::atan(std::tan(0.5) / (4.0 / 3)), 1e-6);
    EXPECT_EQ(again(3), "");
    EXPECT_EQ(again(2), "over the limit of 2 nodes");
    camera.mUp = {0, 0, 1}; // parallel to the view direction
    EXPECT_EQ(again(), "");
    EXPECT_TRUE(scene.cameras.empty());
    EXPECT_EQ(scene.warnings, std::vector<std::string>{"camera right: degenerate; left out"});
    right->mTransformation.b4 = kNan;
    EXPECT_EQ(again(), "node right: expected a finite transform");
}

} // namespace
} // namespace cotan
