// cotan.h: conversion of a model's maps for another frame, in memory, in one step or in two.
#include <algorithm>

#include "bake/reports.hpp"
#include "cotan/convert.hpp"
#include "cotan/gltf.hpp"
#include "cotan/image.hpp"
#include "gltf/json/lookup.hpp"
#include "model_files.hpp"

using namespace cotan;
using namespace cotan::c;

struct cotan_conversion {
    struct NewImage {
        Image image;
        Bytes placeholder; // in the document until the PNG file is given
        bool given = false;
    };
    GltfDocument document;
    ConvertModelReport report;
    std::vector<NewImage> images;
};

namespace {

Json convertJson(const ConvertModelReport& report)
{
    Json json = {{"decisions", decisionsJson(report.decisions)},
                 {"maps", Json::array()},
                 {"unread_maps", Json::array()},
                 {"tangents", tangentsJson(report)},
                 {"notes", report.notes}};
    for (const ConvertedMap& map : report.maps)
        json["maps"].push_back(toJson(map));
    for (const UnreadMap& map : report.unread)
        json["unread_maps"].push_back(
            {{"image", map.image}, {"name", map.name}, {"format", map.format}, {"advice", map.advice}});
    return json;
}

void fill(const ConvertModelReport& report, cotan_convert_result& r)
{
    const std::size_t size = r.size;
    r = {};
    r.size = size;
    r.worst_degrees_before = r.worst_degrees_after = -1;
    const auto updateWorst = [](double& worst, const ValueSummary& map) {
        if (map.count > 0)
            worst = std::max(worst, map.mean);
    };
    for (const ConvertedMap& map : report.maps) {
        const ValueSummary &before = map.figures.unconverted, &after = map.kept ? before : map.figures.error;
        ++(map.kept ? r.maps_kept : r.maps_converted);
        updateWorst(r.worst_degrees_before, before);
        updateWorst(r.worst_degrees_after, after);
    }
    r.primitives_given = report.primitivesGiven;
    r.tangent_bytes_dropped = report.dropped.bytes;
}

ConvertModelOptions optionsFor(const cotan_convert_options& o, const ModelFiles& source)
{
    require(o.threads >= 0, "options.threads: expected 0 or more");
    ConvertModelOptions convert;
    convert.frames = {
        frameOr(o.from, Frame::mikktspace, "options.from"), frameOr(o.to, Frame::orthonormal, "options.to"),
        o.generate_tangents != 0 ? TangentOrigin::generated : TangentOrigin::stored, TangentOrigin::generated};
    convert.bits = o.bits;
    convert.keepTangents = o.keep_tangents != 0;
    const bool chooses = !o.to && o.keep_maps != COTAN_MAPS_UNREAD;
    if (chooses)
        convert.choose = choiceLimitsOf(o.max_degrees);
    convert.keepMaps = o.keep_maps != 0 || chooses;
    convert.readMaps = o.keep_maps != COTAN_MAPS_UNREAD;
    if (convert.keepMaps && readsTangents(convert.frames.to))
        fail(ErrorKind::usage, "options.to: expected a frame without tangents for maps that are kept, found ",
             name(convert.frames.to));
    require(!convert.keepMaps || convert.bits == 0, "options.bits: expected 0 where maps are kept");
    require(!chooses || o.keep_tangents == 0, "options.keep_tangents: expected 0 where frames are chosen");
    const std::string_view expansion = o.expansion ? o.expansion : "biased";
    require(expansion == "biased" || expansion == "exact", "options.expansion: expected biased or exact");
    convert.expansion = expansion == "biased" ? Expansion::biased : Expansion::exact;
    convert.threads = o.threads;
    convert.limits = source.limits();
    convert.encode = source.encoder();
    convert.progress = progressOf(o.progress, o.user);
    return convert;
}

// Opens the document of a model. If the caller names no frame, `from` is the one that the document names, if any.
GltfDocument opened(const ModelFiles& source, const cotan_convert_options& o, ConvertModelOptions& convert)
{
    GltfDocument document = valueOf(openGltfDocument(source.name(), convert.limits));
    if (!o.from && convert.readMaps)
        convert.frames.from = valueOf(namedFrame(document)).value_or(convert.frames.from);
    return document;
}

// Returns bytes that occur in no other file.
Bytes placeholderOf(std::size_t number)
{
    const std::string text = "image of cotan_conversion_set: " + std::to_string(number);
    return copied(text.data(), text.size());
}

cotan_conversion::NewImage& imageAt(cotan_conversion* conversion, std::size_t number)
{
    require(conversion, "conversion: expected one, found null");
    if (number >= conversion->images.size())
        fail(ErrorKind::usage, "number: expected less than ", conversion->images.size(), ", found ", number);
    return conversion->images[number];
}

// Returns the same document with all its files inside, so that the caller's functions are no longer needed.
GltfDocument closedDocument(const GltfDocument& document, const LoadLimits& limits)
{
    LoadLimits inside = limits;
    inside.readFile = [bytes = valueOf(glbBytes(document, limits))](const std::string&) {
        return Result<Bytes>(bytes);
    };
    inside.decode = {};
    return valueOf(openGltfDocument("model.glb", inside));
}

} // namespace

cotan_status cotan_convert_gltf(const void* model, size_t model_size, const cotan_model_files* files,
                                const cotan_convert_options* options, cotan_convert_result* result, cotan_bytes** glb,
                                cotan_bytes** json, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        const cotan_convert_options o = optionsOf(options, "options");
        require(glb, "glb: expected a pointer, found null");
        if (result)
            checked(result, "result");
        const ModelFiles source(model, model_size, files);
        ConvertModelOptions convert = optionsFor(o, source);
        GltfDocument document = opened(source, o, convert);
        const ConvertModelReport report = valueOf(convertModel(document, convert));
        auto made = std::make_unique<cotan_bytes>(cotan_bytes{valueOf(glbBytes(std::move(document), convert.limits))});
        giveText("cotan-convert-result", convertJson(report), json);
        *glb = made.release();
        if (result)
            fill(report, *result);
    });
}

cotan_status cotan_convert_begin(const void* model, size_t model_size, const cotan_model_files* files,
                                 const cotan_convert_options* options, cotan_convert_result* result,
                                 cotan_conversion** conversion, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        const cotan_convert_options o = optionsOf(options, "options");
        require(conversion, "conversion: expected a pointer, found null");
        if (result)
            checked(result, "result");
        const ModelFiles source(model, model_size, files);
        ConvertModelOptions convert = optionsFor(o, source);
        auto made = std::make_unique<cotan_conversion>();
        convert.encode = [&](const Image& image) -> Result<Bytes> {
            made->images.push_back({image, placeholderOf(made->images.size())});
            return made->images.back().placeholder;
        };
        made->document = opened(source, o, convert);
        made->report = valueOf(convertModel(made->document, convert));
        made->document = closedDocument(made->document, convert.limits);
        if (result)
            fill(made->report, *result);
        *conversion = made.release();
    });
}

size_t cotan_conversion_count(const cotan_conversion* conversion) { return conversion ? conversion->images.size() : 0; }

cotan_status cotan_conversion_image(const cotan_conversion* conversion, size_t number, cotan_image_view* view,
                                    char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        checked(view, "view");
        *view = imageViewOf(imageAt(const_cast<cotan_conversion*>(conversion), number).image);
    });
}

cotan_status cotan_conversion_set(cotan_conversion* conversion, size_t number, const void* png, size_t png_size,
                                  char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        cotan_conversion::NewImage& image = imageAt(conversion, number);
        require(png && png_size > 0, "png: expected bytes, found none");
        require(isPng({static_cast<const std::byte*>(png), png_size}), "png: expected a PNG file, found other data");
        require(!image.given, "number: expected an image that has no PNG file yet");
        GltfDocument& document = conversion->document;
        for (std::size_t i = 0; i < countOf(rootOf(document), "images"); ++i)
            if (const auto bytes = gltfImageBytes(document, i); bytes && *bytes == image.placeholder)
                replaceGltfImage(document, i, copied(png, png_size), "image/png");
        std::size_t converted = 0; // maps so far; their images are in the same order
        for (ConvertedMap& map : conversion->report.maps)
            if (!map.kept && converted++ == number)
                map.bytesAfter = png_size;
        image.given = true;
    });
}

cotan_status cotan_convert_end(cotan_conversion* conversion, cotan_bytes** glb, cotan_bytes** json, char* message,
                               size_t message_size)
{
    return call(message, message_size, [&] {
        require(conversion && glb, "conversion and glb: expected both, found null");
        require(std::ranges::all_of(conversion->images, &cotan_conversion::NewImage::given),
                "conversion: expected the PNG files of all images");
        auto made = std::make_unique<cotan_bytes>(cotan_bytes{valueOf(glbBytes(conversion->document))});
        giveText("cotan-convert-result", convertJson(conversion->report), json);
        *glb = made.release();
    });
}

void cotan_conversion_free(cotan_conversion* conversion) { delete conversion; }
