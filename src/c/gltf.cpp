// cotan.h: models in memory.
#include <algorithm>
#include <cstring>

#include "call.hpp"
#include "cotan/convert/convert_model.hpp"
#include "cotan/gltf/edit.hpp"
#include "cotan/gltf/load.hpp"
#include "cotan/lint/lint.hpp"
#include "cotan/report/convert_report.hpp"
#include "cotan/report/json.hpp"
#include "cotan/report/lint_report.hpp"
#include "pictures.hpp"

using namespace cotan;
using namespace cotan::c;

namespace {

using Bytes = std::vector<std::byte>;

Bytes copied(const void* bytes, std::size_t size)
{
    const auto* first = static_cast<const std::byte*>(bytes);
    return size > 0 ? Bytes(first, first + size) : Bytes();
}

// The caller's functions as the library takes them.
class ModelFiles {
public:
    ModelFiles(const void* model, std::size_t size, const cotan_model_files* given)
        : model_(model), size_(size), f_(optionsOf(given, "files"))
    {
        require(model || size == 0, "model: expected bytes, found null");
    }

    // By its first bytes.
    const char* name() const { return size_ >= 4 && std::memcmp(model_, "glTF", 4) == 0 ? "model.glb" : "model.gltf"; }

    // What the library reads it with; lives no longer than this.
    LoadLimits limits() const
    {
        LoadLimits limits;
        limits.pixels = Pixels::whereReadable;
        limits.sandbox = {};
        limits.readFile = [this, opened = false](const std::string& file) mutable -> Result<Bytes> {
            if (!std::exchange(opened, true)) // the model comes first
                return copied(model_, size_);
            return read(file);
        };
        if (f_.decode)
            limits.decode = [this](std::span<const std::byte> bytes, const std::string& picture) {
                return decode(bytes, picture);
            };
        return limits;
    }

    std::function<Result<Bytes>(const Image&)> encoder() const
    {
        if (!f_.encode)
            return {};
        return [this](const Image& image) -> Result<Bytes> {
            const cotan_picture picture = pictureOf(image);
            const void* bytes = nullptr;
            std::size_t size = 0;
            const bool fine = f_.encode(f_.user, &picture, &bytes, &size) == 0 && (bytes || size == 0);
            Bytes png = fine ? copied(bytes, size) : Bytes();
            done();
            return fine ? Result<Bytes>(std::move(png))
                        : outputError(image.name + ": the caller did not encode the picture");
        };
    }

private:
    Result<Bytes> read(const std::string& file) const
    {
        const void* bytes = nullptr;
        std::size_t size = 0;
        const bool fine = f_.read && f_.read(f_.user, file.c_str(), &bytes, &size) == 0 && (bytes || size == 0);
        Bytes read = fine ? copied(bytes, size) : Bytes();
        if (f_.read)
            done();
        return fine ? Result<Bytes>(std::move(read)) : inputError(file + ": there is no such file beside the model");
    }

    Result<Image> decode(std::span<const std::byte> bytes, const std::string& name) const
    try {
        cotan_picture picture{};
        picture.size = sizeof picture;
        if (f_.decode(f_.user, name.c_str(), bytes.data(), bytes.size(), &picture) != 0) {
            done();
            return inputError(name + ": the caller did not decode the picture");
        }
        Image image = imageOf(&picture, name.c_str());
        image.name = name;
        done();
        return image;
    } catch (const Failure& failure) {
        done();
        return failure.error;
    }

    void done() const
    {
        if (f_.done)
            f_.done(f_.user);
    }

    const void* model_;
    std::size_t size_;
    cotan_model_files f_;
};

void giveText(const Json& json, cotan_bytes** to)
{
    if (!to)
        return;
    const std::string text = toText(json);
    const auto bytes = std::as_bytes(std::span(text));
    *to = new cotan_bytes{{bytes.begin(), bytes.end()}};
}

// ---- lint -----------------------------------------------------------------------------------

std::string adviceOf(const LintReport& report)
{
    return report.advice == Advice::nothing ? "" : std::string(name(frameOf(report.advice)));
}

double worst(const LintReport& report, Spread MapFit::*frame)
{
    double degrees = -1;
    for (const MapFit& fit : report.fits)
        if ((fit.*frame).count > 0)
            degrees = std::max(degrees, (fit.*frame).mean);
    return degrees;
}

Json lintJson(const LintReport& report, const Scene& scene)
{
    Json json = {{"recommendation", report.recommendation},
                 {"advice", adviceOf(report)},
                 {"distance", report.distance},
                 {"maps_converted", report.mapsConverted},
                 {"maps_kept", report.mapsKept},
                 {"drops_tangents", report.dropsTangents},
                 {"distrust_stored", report.distrustStored}};
    json.update(listsOf(report));
    json["warnings"] = scene.warnings;
    return json;
}

void fill(const LintReport& report, cotan_lint_result& r)
{
    r.primitives = report.primitives.size();
    r.maps = report.maps.size();
    copyText(adviceOf(report), r.advice, sizeof r.advice);
    r.maps_to_convert = report.mapsConverted;
    r.distrust_stored = report.distrustStored;
    r.green_against =
        std::size_t(std::ranges::count_if(report.maps, [](const GreenEvidence& g) { return !g.asDeclared(); }));
    r.orthonormal_degrees = worst(report, &MapFit::orthonormal);
    r.cotangent_degrees = worst(report, &MapFit::cotangent);
    r.smooth_degrees = worst(report, &MapFit::smooth);
    copyText(report.recommendation, r.recommendation, sizeof r.recommendation);
}

// ---- convert --------------------------------------------------------------------------------

Frame frameOr(const char* given, Frame otherwise, const char* name)
{
    const auto frame = given ? frameFromName(given) : otherwise;
    if (!frame)
        fail(ErrorKind::usage, std::string(name) + ": there is no frame named '" + given + "'");
    return *frame;
}

Json convertJson(const ConvertModelReport& report)
{
    Json json = {{"maps", Json::array()}, {"tangents", tangentsJson(report)}, {"notes", report.notes}};
    for (const ConvertedMap& map : report.maps)
        json["maps"].push_back(toJson(map));
    return json;
}

void fill(const ConvertModelReport& report, cotan_convert_result& r)
{
    const std::size_t size = r.size;
    r = {};
    r.size = size;
    r.worst_degrees_before = r.worst_degrees_after = -1;
    const auto take = [](double& worst, const Spread& map) {
        if (map.count > 0)
            worst = std::max(worst, map.mean);
    };
    for (const ConvertedMap& map : report.maps) {
        const Spread &before = map.figures.unconverted, &after = map.kept ? before : map.figures.error;
        ++(map.kept ? r.maps_kept : r.maps_converted);
        take(r.worst_degrees_before, before);
        take(r.worst_degrees_after, after);
    }
    r.primitives_given = report.primitivesGiven;
    r.tangent_bytes_dropped = report.dropped.bytes;
}

} // namespace

cotan_status cotan_lint_gltf(const void* model, size_t model_size, const cotan_model_files* files,
                             const cotan_lint_options* options, cotan_lint_result* result, cotan_bytes** json,
                             char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        const cotan_lint_options o = optionsOf(options, "options");
        require(o.distance >= 0, "options.distance: expected 0 or more");
        if (result)
            checked(result, "result");
        const ModelFiles source(model, model_size, files);
        const Scene scene = valueOf(loadGltf(source.name(), source.limits()));
        const LintReport report = valueOf(lintScene(scene, {.distance = o.distance}, progressOf(o.progress, o.user)));
        giveText(lintJson(report, scene), json);
        if (result)
            fill(report, *result);
    });
}

cotan_status cotan_convert_gltf(const void* model, size_t model_size, const cotan_model_files* files,
                                const cotan_convert_options* options, cotan_convert_result* result, cotan_bytes** glb,
                                cotan_bytes** json, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        const cotan_convert_options o = optionsOf(options, "options");
        require(glb, "glb: expected a place, found null");
        require(o.threads >= 0, "options.threads: expected 0 or more");
        if (result)
            checked(result, "result");
        const ModelFiles source(model, model_size, files);
        ConvertModelOptions convert;
        convert.frames = {
            frameOr(o.from, Frame::mikktspace, "options.from"), frameOr(o.to, Frame::cotangent, "options.to"),
            o.generate_tangents != 0 ? TangentOrigin::generated : TangentOrigin::stored, TangentOrigin::generated};
        convert.bits = o.bits;
        convert.keepTangents = o.keep_tangents != 0;
        convert.threads = o.threads;
        convert.limits = source.limits();
        convert.encode = source.encoder();
        convert.progress = progressOf(o.progress, o.user);
        GltfDocument document = valueOf(openGltfDocument(source.name(), convert.limits));
        const ConvertModelReport report = valueOf(convertModel(document, convert));
        auto made = std::make_unique<cotan_bytes>(cotan_bytes{valueOf(glbBytes(std::move(document), convert.limits))});
        giveText(convertJson(report), json);
        *glb = made.release();
        if (result)
            fill(report, *result);
    });
}
