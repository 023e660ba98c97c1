// Serialisation of the plain structs of a scene.
#pragma once

#include <optional>
#include <type_traits>

#include "cotan/scene.hpp"
#include "files/sandbox/wire.hpp"

namespace cotan {

template<class W, class T> void exchangeImage(W& w, T& image)
{
    exchangeAll(w, image.name, image.width, image.height);
    w.choice(image.type, PixelType::float32);
    exchangeAll(w, image.data, image.frame, image.channels, image.blocks, image.jpeg);
}

// Properties of an image that are known before its rows are read.
template<class W, class T> void exchangeRowFacts(W& w, T& rows)
{
    exchangeAll(w, rows.width, rows.height);
    w.choice(rows.type, PixelType::float32);
    exchangeAll(w, rows.alpha, rows.whole, rows.frame, rows.channels);
}

template<class W, class T> void exchangeTexture(W& w, T& texture)
{
    exchangeAll(w, texture.image, texture.texcoord);
    w.choice(texture.sampler.wrapU, Wrap::clamp);
    w.choice(texture.sampler.wrapV, Wrap::clamp);
    w.choice(texture.sampler.magnify, Filter::linear);
    w.choice(texture.sampler.minify, Filter::linear);
    w.choice(texture.sampler.mip, MipFilter::linear);
    exchangeAll(w, texture.uRow, texture.vRow);
}

template<class W, class... T> void exchangeTextures(W& w, T&... textures) { (exchangeTexture(w, textures), ...); }

template<class W, class T> void exchangeConvention(W& w, T& c)
{
    w.choice(c.kind, MapKind::height);
    w.choice(c.expansion, Expansion::exact16);
    w.choice(c.channels, Channels::slope);
    w.flag(c.greenUp);
    w.choice(c.v, VDirection::up);
}

// Material properties of extensions.
template<class W, class T> void exchangeLayers(W& w, T& m)
{
    exchangeAll(w, m.coat.strength, m.coat.roughness, m.coat.normalScale);
    exchangeConvention(w, m.coat.normalFormat);
    exchangeTextures(w, m.coat.map, m.coat.roughnessMap, m.coat.normalMap);
    exchangeAll(w, m.anisotropy.strength, m.anisotropy.rotation);
    exchangeTexture(w, m.anisotropy.map);
    exchangeAll(w, m.specular.ior, m.specular.strength, m.specular.color);
    exchangeTextures(w, m.specular.map, m.specular.colorMap);
    exchangeAll(w, m.sheen.color, m.sheen.roughness);
    exchangeTextures(w, m.sheen.colorMap, m.sheen.roughnessMap);
    w.number(m.transmission.strength);
    exchangeTexture(w, m.transmission.map);
    w.number(m.heightMap.depth);
    exchangeTexture(w, m.heightMap.map);
}

template<class W, class T> void exchangeMaterial(W& w, T& m)
{
    exchangeAll(w, m.name, m.baseColor, m.metallic, m.roughness, m.emissive, m.occlusionStrength, m.normalScale);
    exchangeConvention(w, m.normalFormat);
    int frame = m.normalFrame ? int(*m.normalFrame) : -1;
    w.number(frame);
    if constexpr (!std::is_const_v<T>)
        m.normalFrame = isFrame(frame) ? std::optional(Frame(frame)) : std::nullopt;
    w.flag(m.greenReversed);
    w.number(m.copyOf);
    exchangeTextures(w, m.baseColorMap, m.metallicRoughnessMap, m.normalMap, m.occlusionMap, m.emissiveMap);
    w.choice(m.alphaMode, AlphaMode::blend);
    exchangeAll(w, m.alphaCutoff, m.doubleSided, m.unlit);
    exchangeLayers(w, m);
    w.array(m.tangentsFor);
}

template<class W, class T> void exchangeScene(W& w, T& scene)
{
    w.array(scene.name);
    w.list(scene.images, [](W& to, auto& x) { exchangeImage(to, x); });
    w.list(scene.materials, [](W& to, auto& x) { exchangeMaterial(to, x); });
    w.list(scene.meshes, [](W& to, auto& mesh) {
        exchangeAll(to, mesh.name, mesh.material, mesh.positions, mesh.normals, mesh.tangents, mesh.texcoords[0],
                    mesh.texcoords[1], mesh.colors, mesh.cotangentsU, mesh.cotangentsV, mesh.bindPositions,
                    mesh.bindNormals, mesh.skin[0], mesh.skin[1], mesh.skin[2], mesh.indices);
    });
    w.list(scene.instances, [](W& to, auto& x) { exchangeAll(to, x.name, x.mesh, x.toWorld); });
    w.list(scene.lights, [](W& to, auto& light) {
        to.choice(light.kind, LightKind::spot);
        exchangeAll(to, light.color, light.intensity, light.position, light.direction, light.range, light.innerCone,
                    light.outerCone);
    });
    w.list(scene.cameras, [](W& to, auto& camera) {
        exchangeAll(to, camera.name, camera.orthographic, camera.verticalFieldOfView, camera.verticalExtent, camera.eye,
                    camera.target, camera.up);
    });
    w.list(scene.warnings, [](W& to, auto& x) { to.array(x); });
}

} // namespace cotan
