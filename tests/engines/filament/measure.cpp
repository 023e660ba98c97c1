// Draws the rings in Filament: measure MATERIAL KIND PARTS TANGENTS OUT, in a folder with left/ and right/ (position,
// normal, uv, corners), KIND_left.raw and KIND_right.raw (RGB maps), and matrices (two of 16 floats). PARTS: 2 draws
// numbers, by the parameter `part` of the material, into images of floats; 1 draws a lit image of bytes, RGB. TANGENTS:
// 1: those that Filament computes; 0: normals alone.
#include <filament/Camera.h>
#include <filament/Engine.h>
#include <filament/IndexBuffer.h>
#include <filament/LightManager.h>
#include <filament/Material.h>
#include <filament/MaterialInstance.h>
#include <filament/RenderTarget.h>
#include <filament/RenderableManager.h>
#include <filament/Renderer.h>
#include <filament/Scene.h>
#include <filament/SwapChain.h>
#include <filament/Texture.h>
#include <filament/TextureSampler.h>
#include <filament/TransformManager.h>
#include <filament/VertexBuffer.h>
#include <filament/View.h>
#include <filament/Viewport.h>
#include <geometry/SurfaceOrientation.h>
#include <utils/EntityManager.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <list>
#include <string>
#include <vector>

using namespace filament;
using math::float2, math::float3, math::float4, math::mat4f, math::quatf, math::ushort3;

template<typename T> std::vector<T>& read(const std::string& name)
{
    static std::list<std::vector<T>> kept; // Filament reads buffers later
    std::ifstream file(name, std::ios::binary);
    std::vector<char> bytes((std::istreambuf_iterator<char>(file)), {});
    if (bytes.empty()) {
        std::fprintf(stderr, "%s: cannot be read\n", name.c_str());
        std::exit(2);
    }
    kept.emplace_back(bytes.size() / sizeof(T));
    std::copy(bytes.begin(), bytes.begin() + kept.back().size() * sizeof(T),
              reinterpret_cast<char*>(kept.back().data()));
    return kept.back();
}

template<typename T> backend::BufferDescriptor bufferOf(const std::vector<T>& data)
{
    return {data.data(), data.size() * sizeof(T)};
}

Texture* textureOf(Engine& engine, const std::vector<unsigned char>& pixels, unsigned width, unsigned height)
{
    auto levels = static_cast<uint8_t>(1 + std::floor(std::log2(std::max(width, height))));
    auto* texture = Texture::Builder()
                        .width(width)
                        .height(height)
                        .levels(levels)
                        .format(Texture::InternalFormat::RGB8)
                        .build(engine);
    texture->setImage(engine, 0, {pixels.data(), pixels.size(), Texture::Format::RGB, Texture::Type::UBYTE});
    texture->generateMipmaps(engine);
    return texture;
}

VertexBuffer* verticesOf(Engine& engine, const std::string& folder, bool tangents)
{
    auto& position = read<float3>(folder + "/position");
    auto& normal = read<float3>(folder + "/normal");
    auto& uv = read<float2>(folder + "/uv");
    auto& corners = read<ushort3>(folder + "/corners");
    geometry::SurfaceOrientation::Builder builder;
    builder.vertexCount(position.size()).normals(normal.data());
    if (tangents)
        builder.uvs(uv.data()).positions(position.data()).triangleCount(corners.size()).triangles(corners.data());
    auto* orientation = builder.build();
    static std::list<std::vector<quatf>> kept;
    auto& quaternions = kept.emplace_back(position.size());
    orientation->getQuats(quaternions.data(), quaternions.size());
    using Type = VertexBuffer::AttributeType;
    auto* vertices = VertexBuffer::Builder()
                         .vertexCount(static_cast<uint32_t>(position.size()))
                         .bufferCount(3)
                         .attribute(VertexAttribute::POSITION, 0, Type::FLOAT3)
                         .attribute(VertexAttribute::TANGENTS, 1, Type::FLOAT4)
                         .attribute(VertexAttribute::UV0, 2, Type::FLOAT2)
                         .build(engine);
    vertices->setBufferAt(engine, 0, bufferOf(position));
    vertices->setBufferAt(engine, 1, bufferOf(quaternions));
    vertices->setBufferAt(engine, 2, bufferOf(uv));
    return vertices;
}

int main(int count, char** words)
{
    if (count != 6)
        return 1;
    const uint32_t width = 768, height = 384;
    const std::string kind = words[2];
    const int parts = std::atoi(words[3]);
    Engine* engine = Engine::create(Engine::Backend::OPENGL);
    SwapChain* chain = engine->createSwapChain(width, height);
    Renderer* renderer = engine->createRenderer();
    Scene* scene = engine->createScene();
    View* view = engine->createView();
    utils::Entity eye = utils::EntityManager::get().create();
    Camera* camera = engine->createCamera(eye);
    camera->setProjection(30, double(width) / height, 0.1, 100);
    camera->lookAt({0, 0, 5}, {0, 0, 0});
    camera->setExposure(1.0F);
    const auto format = parts == 2 ? Texture::InternalFormat::RGBA32F : Texture::InternalFormat::RGBA8;
    const auto usage = Texture::Usage::COLOR_ATTACHMENT | Texture::Usage::SAMPLEABLE;
    auto* color = Texture::Builder().width(width).height(height).format(format).usage(usage).build(*engine);
    auto* depth = Texture::Builder()
                      .width(width)
                      .height(height)
                      .format(Texture::InternalFormat::DEPTH32F)
                      .usage(Texture::Usage::DEPTH_ATTACHMENT)
                      .build(*engine);
    auto* target = RenderTarget::Builder()
                       .texture(RenderTarget::AttachmentPoint::COLOR, color)
                       .texture(RenderTarget::AttachmentPoint::DEPTH, depth)
                       .build(*engine);
    view->setScene(scene);
    view->setCamera(camera);
    view->setViewport({0, 0, width, height});
    view->setRenderTarget(target);
    view->setPostProcessingEnabled(false);
    renderer->setClearOptions({{0, 0, 0, 0}, true, true});

    utils::Entity sun = utils::EntityManager::get().create();
    LightManager::Builder(LightManager::Type::DIRECTIONAL)
        .direction({0.5F, -0.6F, -0.6F})
        .intensity(2.5F)
        .build(*engine, sun);
    scene->addEntity(sun);

    auto& package = read<char>(words[1]);
    Material* material = Material::Builder().package(package.data(), package.size()).build(*engine);
    if (!material)
        return 3;
    TextureSampler sampler(TextureSampler::MinFilter::LINEAR_MIPMAP_LINEAR, TextureSampler::MagFilter::LINEAR,
                           TextureSampler::WrapMode::REPEAT);
    sampler.setAnisotropy(16);
    const std::vector<unsigned char> white(4 * 4 * 3, 255);
    auto& matrices = read<mat4f>("matrices");
    std::vector<MaterialInstance*> instances;
    for (const char* side : {"left", "right"}) {
        auto* instance = material->createInstance();
        auto& map = read<unsigned char>(kind + "_" + side + ".raw");
        const unsigned across = map.size() == 48 ? 4 : 2048, down = map.size() == 48 ? 4 : 1024;
        instance->setParameter("normalMap", textureOf(*engine, map, across, down), sampler);
        instance->setParameter("baseColorMap", textureOf(*engine, white, 4, 4), sampler);
        instance->setParameter("roughness", 0.6F);
        instance->setParameter("metallic", 0.0F);
        auto& corners = read<uint16_t>(std::string(side) + "/corners");
        auto* indices = IndexBuffer::Builder()
                            .indexCount(static_cast<uint32_t>(corners.size()))
                            .bufferType(IndexBuffer::IndexType::USHORT)
                            .build(*engine);
        indices->setBuffer(*engine, bufferOf(corners));
        utils::Entity entity = utils::EntityManager::get().create();
        RenderableManager::Builder(1)
            .boundingBox({{0, 0, 0}, {1, 1, 1}})
            .material(0, instance)
            .geometry(0, RenderableManager::PrimitiveType::TRIANGLES, verticesOf(*engine, side, std::atoi(words[4])),
                      indices)
            .build(*engine, entity);
        auto& transforms = engine->getTransformManager();
        transforms.setTransform(transforms.getInstance(entity), matrices[instances.size()]);
        scene->addEntity(entity);
        instances.push_back(instance);
    }

    std::FILE* file = std::fopen(words[5], "wb");
    for (int part = 0; part < parts; ++part) {
        if (parts == 2)
            for (auto* instance : instances)
                instance->setParameter("part", float(part));
        const size_t pixel = parts == 2 ? 16 : 4;
        std::vector<unsigned char> pixels(width * height * pixel);
        for (int frame = 0; frame < 3; ++frame) {
            while (!renderer->beginFrame(chain))
                engine->flushAndWait();
            renderer->render(view);
            if (frame == 2)
                renderer->readPixels(target, 0, 0, width, height,
                                     {pixels.data(), pixels.size(), Texture::Format::RGBA,
                                      parts == 2 ? Texture::Type::FLOAT : Texture::Type::UBYTE});
            renderer->endFrame();
            engine->flushAndWait();
        }
        for (size_t i = 0; i < size_t(width) * height; ++i) // Filament's rows run down
            std::fwrite(&pixels[i * pixel], parts == 2 ? pixel : 3, 1, file);
    }
    std::fclose(file);
    std::puts("DONE");
    std::fflush(stdout);
    std::_Exit(0);
}
