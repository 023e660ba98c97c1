// What the plain structs of a scene are on the wire.
#pragma once

#include <optional>
#include <type_traits>

#include "cotan/scene.hpp"
#include "files/sandbox/wire.hpp"

namespace cotan {

template<class W, class T> void exchangeImage(W& w, T& image)
{
    w.text(image.name);
    w.number(image.width);
    w.number(image.height);
    w.choice(image.type, PixelType::float32);
    w.array(image.data);
    w.text(image.frame);
    w.number(image.channels);
}

// What is known of a picture before its rows.
template<class W, class T> void exchangeRowFacts(W& w, T& rows)
{
    w.number(rows.width);
    w.number(rows.height);
    w.choice(rows.type, PixelType::float32);
    w.flag(rows.alpha);
    w.flag(rows.whole);
    w.text(rows.frame);
    w.number(rows.channels);
}

template<class W, class T> void exchangeTexture(W& w, T& texture)
{
    w.number(texture.image);
    w.number(texture.texcoord);
    w.choice(texture.sampler.wrapU, Wrap::clamp);
    w.choice(texture.sampler.wrapV, Wrap::clamp);
    w.choice(texture.sampler.magnify, Filter::linear);
    w.choice(texture.sampler.minify, Filter::linear);
    w.choice(texture.sampler.mip, MipFilter::linear);
    w.number(texture.uRow);
    w.number(texture.vRow);
}

template<class W, class T> void exchangeConvention(W& w, T& c)
{
    w.choice(c.kind, MapKind::height);
    w.choice(c.expansion, Expansion::exact16);
    w.choice(c.channels, Channels::slope);
    w.flag(c.greenUp);
    w.choice(c.v, VDirection::up);
}

// What extensions add to a material.
template<class W, class T> void exchangeLayers(W& w, T& m)
{
    w.number(m.coat.strength);
    w.number(m.coat.roughness);
    w.number(m.coat.normalScale);
    exchangeConvention(w, m.coat.normalFormat);
    exchangeTexture(w, m.coat.map);
    exchangeTexture(w, m.coat.roughnessMap);
    exchangeTexture(w, m.coat.normalMap);
    w.number(m.anisotropy.strength);
    w.number(m.anisotropy.rotation);
    exchangeTexture(w, m.anisotropy.map);
    w.number(m.specular.ior);
    w.number(m.specular.strength);
    w.number(m.specular.color);
    exchangeTexture(w, m.specular.map);
    exchangeTexture(w, m.specular.colorMap);
    w.number(m.sheen.color);
    w.number(m.sheen.roughness);
    exchangeTexture(w, m.sheen.colorMap);
    exchangeTexture(w, m.sheen.roughnessMap);
    w.number(m.transmission.strength);
    exchangeTexture(w, m.transmission.map);
}

template<class W, class T> void exchangeMaterial(W& w, T& m)
{
    w.text(m.name);
    w.number(m.baseColor);
    w.number(m.metallic);
    w.number(m.roughness);
    w.number(m.emissive);
    w.number(m.occlusionStrength);
    w.number(m.normalScale);
    exchangeConvention(w, m.normalFormat);
    int frame = m.normalFrame ? int(*m.normalFrame) : -1;
    w.number(frame);
    if constexpr (!std::is_const_v<T>)
        m.normalFrame = isFrame(frame) ? std::optional(Frame(frame)) : std::nullopt;
    w.flag(m.greenReversed);
    exchangeTexture(w, m.baseColorMap);
    exchangeTexture(w, m.metallicRoughnessMap);
    exchangeTexture(w, m.normalMap);
    exchangeTexture(w, m.occlusionMap);
    exchangeTexture(w, m.emissiveMap);
    w.choice(m.alphaMode, AlphaMode::blend);
    w.number(m.alphaCutoff);
    w.flag(m.doubleSided);
    w.flag(m.unlit);
    exchangeLayers(w, m);
    w.text(m.tangentsFor);
}

template<class W, class T> void exchangeMesh(W& w, T& mesh)
{
    w.text(mesh.name);
    w.number(mesh.material);
    w.array(mesh.positions);
    w.array(mesh.normals);
    w.array(mesh.tangents);
    w.array(mesh.texcoords[0]);
    w.array(mesh.texcoords[1]);
    w.array(mesh.colors);
    w.array(mesh.cotangentsU);
    w.array(mesh.cotangentsV);
    w.array(mesh.indices);
}

template<class W, class T> void exchangeLight(W& w, T& light)
{
    w.choice(light.kind, LightKind::spot);
    w.number(light.color);
    w.number(light.intensity);
    w.number(light.position);
    w.number(light.direction);
    w.number(light.range);
    w.number(light.innerCone);
    w.number(light.outerCone);
}

template<class W, class T> void exchangeCamera(W& w, T& camera)
{
    w.text(camera.name);
    w.flag(camera.orthographic);
    w.number(camera.verticalFieldOfView);
    w.number(camera.verticalExtent);
    w.number(camera.eye);
    w.number(camera.target);
    w.number(camera.up);
}

template<class W, class T> void exchangeInstance(W& w, T& instance)
{
    w.text(instance.name);
    w.number(instance.mesh);
    w.number(instance.toWorld);
}

template<class W, class T> void exchangeScene(W& w, T& scene)
{
    w.text(scene.name);
    w.list(scene.images, [](W& to, auto& x) { exchangeImage(to, x); });
    w.list(scene.materials, [](W& to, auto& x) { exchangeMaterial(to, x); });
    w.list(scene.meshes, [](W& to, auto& x) { exchangeMesh(to, x); });
    w.list(scene.instances, [](W& to, auto& x) { exchangeInstance(to, x); });
    w.list(scene.lights, [](W& to, auto& x) { exchangeLight(to, x); });
    w.list(scene.cameras, [](W& to, auto& x) { exchangeCamera(to, x); });
    w.list(scene.warnings, [](W& to, auto& x) { to.text(x); });
}

} // namespace cotan
