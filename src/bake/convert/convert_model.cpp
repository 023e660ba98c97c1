#include "cotan/convert.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "bake/convert/choose_primitives.hpp"
#include "bake/convert/map_jobs.hpp"
#include "bake/surface/nearest_texels.hpp"
#include "core/try.hpp"
#include "cotan/image.hpp"
#include "cotan/maps.hpp"
#include "gltf/json/lookup.hpp"
#include "image/component_types.hpp"

namespace cotan {

namespace {

constexpr double kVisible = 0.5;   // degrees on average over a map: smaller errors are invisible
constexpr double kMaxRows = 4e7;   // of texels under all triangles together
constexpr double kMaxGrowth = 1.1; // of the file of a map whose green is reversed: other encoders take a few percent

class ModelConverter {
public:
    // scene: of the document, if there is one.
    ModelConverter(GltfDocument& document, std::optional<Scene> scene, const ConvertModelOptions& options)
        : options_(options), given_(document), document_(document), scene_(std::move(scene))
    {
    }

    Result<ConvertModelReport> run()
    {
        COTAN_TRY(named, options_.readMaps ? namedFrame(document_) : Result<std::optional<Frame>>(std::nullopt));
        if (*named && **named != options_.frames.from)
            return inputError(fmt::format("{}its materials say that the normal maps are for the frame {}; expected "
                                          "that as the frame to convert from, found {}",
                                          fileOf(document_), name(**named), name(options_.frames.from)));
        named_ = named->has_value();
        COTAN_CHECK(chooseFramesOfPrimitives());
        COTAN_CHECK(options_.readMaps ? convertMaps() : keepReversingTangents());
        COTAN_CHECK(updateTangents());
        noteKeptTangents();
        if (!options_.keepMaps && !std::ranges::all_of(report_.maps, &ConvertedMap::kept)
            && options_.frames.to != Frame::mikktspace)
            report_.notes.push_back(
                fmt::format("the maps are now for the frame {}; readers that generate MikkTSpace tangents where "
                            "TANGENT is missing, as glTF specifies, will shade them incorrectly",
                            name(options_.frames.to)));
        given_ = std::move(document_);
        return std::move(report_);
    }

private:
    // Names the chosen frames; those of other conversions replace the names.
    Status chooseFramesOfPrimitives()
    {
        std::optional<Scene> scene = std::exchange(scene_, std::nullopt); // its memory is free before maps are read
        if (options_.choose) {
            COTAN_TRY(
                decisions,
                choosePrimitives(document_, *options_.choose, options_.frames, options_.limits, std::move(scene)));
            report_.decisions = std::move(*decisions);
        }
        return forEachPrimitive(rootOf(document_), [&](std::size_t m, std::size_t p) -> Status {
            const FrameDecision* const d = decisionOf(report_.decisions, {m, p});
            const bool reads = d && d->reason != ChoiceReason::noMap && d->reason != ChoiceReason::notJudged;
            if (options_.choose ? reads : !options_.keepMaps)
                nameFrameOfPrimitive(document_, {m, p}, reads ? std::optional(d->frame) : std::nullopt);
            return Done{};
        });
    }

    // Readers that keep TANGENT, and the frames of the others.
    void applyDecisions(std::vector<MapJob>& jobs)
    {
        std::map<SourcePrimitive, std::size_t> readers;
        for (const MapJob& job : jobs)
            for (const MapReader& reader : job.readers)
                ++readers[{reader.mesh, reader.primitive}];
        for (MapJob& job : jobs)
            for (MapReader& reader : job.readers)
                if (const FrameDecision* const d = decisionOf(report_.decisions, {reader.mesh, reader.primitive})) {
                    reader.readWith = d->frame;
                    if (d->dropsTangents() || !reader.stored)
                        continue;
                    const bool needed = std::exchange(reader.keeps, true);
                    reader.reversed = false; // without tangents it is not read
                    const gltf::Json& primitive =
                        rootOf(document_)["meshes"][reader.mesh]["primitives"][reader.primitive];
                    const gltf::Json& material = rootOf(document_)["materials"][reader.slot.material];
                    reader.follows = !needed && readers[{reader.mesh, reader.primitive}] == 1
                        && !primitive.contains("targets") && gltf::tangentReader(material).empty();
                }
        for (const PrimitiveDecision& d : report_.decisions)
            if (!d.decision.dropsTangents())
                keptTangents_.push_back({d.primitive.mesh, d.primitive.primitive, 0, ""});
    }

    Status convertMaps()
    {
        COTAN_TRY(jobs, mapJobs(document_, report_.notes, options_.limits));
        applyDecisions(*jobs);
        report_.unread = unreadNormalMaps(document_, options_.limits);
        for (const UnreadMap& map : report_.unread)
            report_.notes.push_back(
                fmt::format("{}: a normal map in {} is not supported; it and its tangents are unchanged: {}", map.name,
                            map.format, map.advice));
        COTAN_CHECK(checkMemory(*jobs));
        for (const MapJob& job : *jobs)
            surfaces_ += surfacesOf(job);
        if (jobs->empty() && report_.unread.empty()) // otherwise their notes say why
            report_.notes.push_back("no primitive has a normal map and uv: nothing to convert");
        for (std::size_t k = 0; k < jobs->size(); ++k) {
            const Progress mapProgress = partOf(options_.progress, k, jobs->size());
            COTAN_TRY(map, convertMap((*jobs)[k], mapProgress));
            if (mapProgress && !mapProgress(1))
                return stoppedError();
            report_.maps.push_back(std::move(*map));
        }
        for (const MapJob& job : *jobs)
            for (const MapSlot& slot : options_.keepMaps ? std::vector<MapSlot>{} : job.slots)
                nameFrame(document_, slot.material, options_.frames.to);
        return Done{};
    }

    // Of maps that are not read: they cannot get their green reversed.
    Status keepReversingTangents()
    {
        if (options_.frames.fromTangents != TangentOrigin::stored)
            return Done{};
        std::vector<std::string> aboutMaps; // that stay as they are
        COTAN_TRY(jobs, mapJobs(document_, aboutMaps, options_.limits, true));
        for (const MapJob& job : *jobs) {
            ConvertedMap none;
            if (std::ranges::any_of(job.readers, showsReversed))
                keepTangents(job, none, fmt::format("its tangents reverse green of {}", job.name));
        }
        return Done{};
    }

    std::string fieldOf(const MapJob& job) const { return fileOf(document_) + job.name; }

    Status checkMemory(const std::vector<MapJob>& jobs) const
    {
        for (const MapJob& job : jobs)
            if (const std::size_t bytes = bytesOf(job, options_.frames); options_.memory > 0 && bytes > options_.memory)
                return memoryError(fmt::format("{}: the triangles that use it take {} MiB, the limit is {} MiB",
                                               fieldOf(job), bytes >> 20, options_.memory >> 20));
        return Done{};
    }

    // What is wrong with a map as a file stays wrong in the converted one.
    void noteFaults(const maps::NormalStatistics& s, const std::string& name)
    {
        if (std::string faults = maps::sentenceOf(name, maps::faultsInModel(s), s); !faults.empty())
            report_.notes.push_back(std::move(faults));
        if (const std::string note = maps::noteOf(s); !note.empty())
            report_.notes.push_back(name + ": " + note);
    }

    struct Expansions {
        Expansion read, written;
    };

    // How the engines that the file is converted for read the map, and how the new one is written.
    Expansions expansionsOf(const MapJob& job) const
    {
        const bool ofCoat =
            std::ranges::any_of(job.slots, [](const MapSlot& slot) { return slot.kind == NormalSlot::coat; });
        const Expansion written = ofCoat ? Expansion::exact : options_.expansion;
        const bool declaredBiased = std::ranges::any_of(job.slots, [&](const MapSlot& slot) {
            return gltf::expansionOf(rootOf(document_)["materials"][slot.material]) == Expansion::biased;
        });
        return {declaredBiased ? Expansion::biased : written, written};
    }

    // Converts one image and replaces it in the document.
    Result<ConvertedMap> convertMap(const MapJob& job, const Progress& mapProgress)
    {
        const std::string field = fieldOf(job);
        COTAN_TRY(bytes, gltfImageBytes(document_, job.image, options_.limits));
        COTAN_TRY(map, decodeImage(*bytes, field, options_.limits));
        // The frame that an image names counts only if the materials name none.
        if (const auto named = frameFromName(map->frame); named && !named_ && *named != options_.frames.from)
            return inputError(
                fmt::format("{}: the image says that it is for the frame {}; expected that as the frame to "
                            "convert from, found {}",
                            field, map->frame, name(options_.frames.from)));
        completeNormals(*map);
        ConvertedMap done{job.image, job.name, surfacesOf(job), map->width, map->height};
        COTAN_TRY(uses, usesOf(document_, job, options_.frames));
        const maps::NormalStatistics statistics = maps::statisticsOfSample(*map);
        noteFaults(statistics, job.name);
        const Expansions expansions = expansionsOf(job);
        for (MapUse& use : *uses)
            use.stored.expansion = expansions.read;
        done.alsoElsewhere = job.alsoElsewhere;
        done.readWith = framesOf(job);
        done.bytesBefore = done.bytesAfter = bytes->size();
        done.format = imageFormatName(*bytes);
        // The old map stays, byte for byte, if it serves as well as a rounded new one.
        const std::size_t points = pointsOfEach(surfaces_);
        done.figures.unconverted = mapError(*map, *map, *uses, options_.frames, {}, points);
        if (options_.keepMaps) {
            const bool shownByTangents =
                readsTangents(options_.frames.from) && options_.frames.fromTangents == TangentOrigin::stored;
            const GreenWithoutTangents green =
                shownByTangents ? greenWithoutTangents(job) : GreenWithoutTangents::declared;
            if (green == GreenWithoutTangents::reversed)
                return withGreenReversed( // about whatever engines take for zero
                    job, std::move(done), *map, *bytes, *uses,
                    statistics.centre == maps::Centre::biased ? Expansion::biased : expansions.read);
            if (shownByTangents && std::ranges::any_of(job.readers, showsReversed))
                keepTangents(job, done,
                             fmt::format("its tangents reverse green of {}, which {}", job.name,
                                         green == GreenWithoutTangents::both
                                             ? "other surfaces show as declared"
                                             : "stays, since a coat or anisotropy needs the tangents"));
            for (const MapReader& reader : job.readers)
                if (reader.keeps && !showsReversed(reader))
                    done.surfacesWithTangents += reader.transforms.size();
            if (done.surfacesWithTangents > 0)
                done.figures.unconverted = mapError(
                    *map, *map,
                    usesBy(job, *uses, [](const MapReader& reader) { return !showsReversed(reader) && !reader.keeps; }),
                    options_.frames, {}, points);
        }
        done.kept = options_.keepMaps || done.figures.unconverted.count == 0
            || (options_.bits == 0 && fitsAsItIs(done.figures.unconverted));
        if (done.kept) {
            noteErrorOfKept(done);
            return done;
        }
        if (std::max(map->width, map->height) > kLargestSide)
            return inputError(fmt::format("{}: expected a map of at most {} texels a side; found {} x {}", field,
                                          kLargestSide, map->width, map->height));
        if (const double rows = rowsOf(*uses, map->height); !(rows <= kMaxRows))
            return inputError(
                fmt::format("{}: its triangles cover {:.3g} rows of its texels in total; expected at most "
                            "{:.3g}: use fewer triangles that repeat the map, or a smaller map",
                            field, rows, kMaxRows));
        done.bits = options_.bits != 0 ? options_.bits : map->type == PixelType::unorm8 ? 8 : 16;
        CountedSteps rows(mapProgress, std::size_t(map->height));
        Reencoded r = reencode(*map, *uses, options_.frames, done.bits, options_.threads, &rows, expansions.written);
        if (rows.stopped())
            return stoppedError();
        r.image.frame = name(options_.frames.to);
        const ValueSummary unconverted = done.figures.unconverted;
        done.figures = r;
        COTAN_TRY(file,
                  encodedWithin(std::max(kVisible, 0.5 * unconverted.mean), r.image, *bytes, *map, *uses,
                                expansions.written, done));
        put(job, std::move(*file), expansions.written, done);
        noteRemainingError(done);
        return done;
    }

    // Encodes a new map in the format of the old file, or as PNG if its losses would give a mean error over `limit`;
    // what the caller encodes stays as it is. Sets done.figures.error to that of the map as it is stored.
    Result<EncodedLike> encodedWithin(double limit, const Image& image, std::span<const std::byte> old,
                                      const Image& before, std::span<const MapUse> uses, Expansion written,
                                      ConvertedMap& done)
    {
        auto file = encoded(image, old);
        const bool byCaller = file && options_.encode && isPng(file->bytes);
        if (!file || (file->format == "PNG" && !byCaller))
            return file;
        const std::string field = fileOf(document_) + done.name;
        COTAN_TRY(stored, decodeImage(file->bytes, field, options_.limits));
        if (stored->width != image.width || stored->height != image.height)
            return outputError(fmt::format("{}: expected an encoded image of {} x {}, found {} x {}", field,
                                           image.width, image.height, stored->width, stored->height));
        const ValueSummary lossy = mapError(before, *stored, uses, options_.frames, written);
        if (lossy.mean > limit && byCaller)
            report_.notes.push_back(fmt::format(
                "{}: as encoded by the caller, its error is {:.2f} degrees on average, without losses {:.2f}",
                done.name, lossy.mean, done.figures.error.mean));
        if (lossy.mean <= limit || byCaller) {
            done.figures.error = lossy;
            return file;
        }
        COTAN_TRY(png, encodePng(image));
        return EncodedLike{*std::move(png), "PNG", "image/png", 0,
                           fmt::format("{} of quality {} would have an error of {:.2f} degrees on average, PNG {:.2f}",
                                       file->format, file->quality, lossy.mean, done.figures.error.mean)};
    }

    // Puts a new map into the document.
    void put(const MapJob& job, EncodedLike file, Expansion written, ConvertedMap& done)
    {
        done.bytesAfter = file.bytes.size();
        done.format = file.format;
        done.quality = file.quality;
        if (!file.reason.empty())
            report_.notes.push_back(fmt::format("{}: {}, so the new map is PNG: {} bytes, before {}", job.name,
                                                file.reason, done.bytesAfter, done.bytesBefore));
        replaceMap(document_, job, std::move(file.bytes), file.mime, report_.notes);
        for (const MapSlot& slot : job.slots) // readers of the new map need this
            if (slot.kind == NormalSlot::surface)
                setExpansion(rootOf(document_)["materials"][slot.material], written);
    }

    // Reverses green about its zero and keeps all else of the map, unless it would grow by over kMaxGrowth.
    Result<ConvertedMap> withGreenReversed(const MapJob& job, ConvertedMap done, const Image& map,
                                           std::span<const std::byte> old, std::vector<MapUse> uses, Expansion read)
    {
        uses = usesBy(job, uses, [](const MapReader& reader) { return !reader.keeps; });
        for (MapUse& use : uses)
            use.stored.expansion = read;
        maps::RecodeSettings settings;
        settings.from.expansion = settings.to.expansion = read;
        settings.from.greenUp = !settings.to.greenUp;
        settings.type = map.type;
        maps::RecodeCounts counts;
        const Image reversed = maps::recode(map, settings, counts);
        ConvertedMap made = done;
        made.greenReversed = true;
        made.bits = bitsPerComponent(map.type);
        made.figures.error = mapError(map, reversed, uses, options_.frames);
        COTAN_TRY(file, encodedWithin(made.figures.error.mean + kVisible, reversed, old, map, uses, read, made));
        if (double(file->bytes.size()) > kMaxGrowth * double(old.size())) {
            keepTangents(
                job, done,
                fmt::format("its tangents reverse green of {}, which would grow from {} to {} bytes with green "
                            "reversed",
                            job.name, old.size(), file->bytes.size()));
            done.kept = true;
            return done;
        }
        put(job, std::move(*file), read, made);
        for (const MapReader& reader : job.readers)
            if (reader.follows) {
                made.surfacesWithTangents += reader.transforms.size();
                COTAN_CHECK(reverseBitangents(document_, reader.mesh, reader.primitive));
            }
        report_.notes.push_back(fmt::format("{}: the tangents of the file reverse its green; without them, the map has "
                                            "its green reversed",
                                            job.name));
        noteErrorOfKept(made);
        return made;
    }

    // The frames that the surfaces without tangents read a map with.
    std::vector<Frame> framesOf(const MapJob& job) const
    {
        std::vector<Frame> frames;
        for (const MapReader& reader : job.readers)
            if (!reader.keeps)
                frames.push_back(reader.readWith.value_or(options_.frames.to));
        std::ranges::sort(frames);
        frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
        return frames;
    }

    // The surfaces that read a map with green reversed keep their tangents. uses: of the job.
    void keepTangents(const MapJob& job, ConvertedMap& done, const std::string& reason)
    {
        for (const MapReader& reader : job.readers)
            if (showsReversed(reader)) {
                keptTangents_.push_back({reader.mesh, reader.primitive, reader.slot.material, reason});
                if (options_.choose) {
                    nameFrameOfPrimitive(document_, {reader.mesh, reader.primitive}, options_.frames.from);
                    if (FrameDecision* const d = decisionOf(report_.decisions, {reader.mesh, reader.primitive})) {
                        d->frame = options_.frames.from;
                        d->tangents = TangentOrigin::stored;
                    }
                }
                done.surfacesWithTangents += reader.transforms.size();
            }
    }

    // The uses by some readers. uses: of the job.
    template<class Which>
    static std::vector<MapUse> usesBy(const MapJob& job, const std::vector<MapUse>& uses, const Which& which)
    {
        std::vector<MapUse> found;
        auto use = uses.begin();
        for (const MapReader& reader : job.readers) {
            const auto next = use + std::ptrdiff_t(reader.transforms.size());
            if (which(reader))
                found.insert(found.end(), use, next);
            use = next;
        }
        return found;
    }

    void noteErrorOfKept(const ConvertedMap& map)
    {
        const ValueSummary& error = map.greenReversed ? map.figures.error : map.figures.unconverted;
        if (options_.keepMaps && map.surfacesWithTangents < map.surfaces && error.mean > kVisible)
            report_.notes.push_back(fmt::format("{}: {} and read with {}, its error is {:.1f} degrees on average",
                                                map.name, map.greenReversed ? "with green reversed" : "unchanged",
                                                namesOf(map.readWith), error.mean));
    }

    // Encodes in the format of the old file, or by options_.encode.
    Result<EncodedLike> encoded(const Image& image, std::span<const std::byte> old) const
    {
        // A WebP image that is not required has a fallback for other readers; the new image must serve all readers.
        const auto* const required = gltf::member(rootOf(document_), "extensionsRequired");
        const bool webp = imageFormatName(old) == "WebP";
        const bool fallsBack =
            webp && (!required || std::ranges::find(*required, "EXT_texture_webp") == required->end());
        if (!options_.encode && !fallsBack)
            return encodeLike(image, old);
        COTAN_TRY(png, options_.encode ? options_.encode(image) : encodePng(image));
        return EncodedLike{*std::move(png), "PNG", "image/png", 0,
                           fallsBack ? "the model does not require its readers to support WebP" : ""};
    }

    // Rows of texels under all triangles; those of a surface with several placings count once.
    static double rowsOf(const std::vector<MapUse>& uses, int height)
    {
        double rows = 0;
        for (std::size_t i = 0; i < uses.size(); ++i)
            if (i == 0 || uses[i].surface.shared != uses[i - 1].surface.shared)
                rows += rowsUnder(uses[i].surface, height);
        return rows;
    }

    void noteRemainingError(const ConvertedMap& map)
    {
        const ReencodeFigures& r = map.figures;
        const double fraction = double(r.disagreeing) / double(std::max<std::size_t>(r.covered, 1));
        if (fraction * r.disagreement.mean > kVisible)
            report_.notes.push_back(fmt::format(
                "{}: on {:.0f} % of it several surface points share a texel but need different values; the error is "
                "{:.1f} degrees on average at the worst of them. No single map fits; give these parts their own texels",
                map.name, 100 * fraction, r.disagreement.mean));
        else if (r.error.mean > kVisible)
            report_.notes.push_back(
                fmt::format("{}: after conversion the error is still {:.1f} degrees on average: its texels are too "
                            "coarse for the surface",
                            map.name, r.error.mean));
    }

    Status updateTangents()
    {
        if (readsTangents(options_.frames.to)) {
            report_.tangents = TangentsAfter::given;
            COTAN_TRY(
                given,
                giveTangents(
                    document_,
                    {.frame = options_.frames.to, .replace = true, .mappedOnly = true, .threads = options_.threads}));
            report_.primitivesGiven = given->generated;
            return Done{};
        }
        if (options_.keepTangents) {
            report_.tangents = TangentsAfter::kept;
            if (!options_.keepMaps)
                report_.notes.push_back(
                    "TANGENT is kept; a reader that uses it will shade the converted maps incorrectly");
            return Done{};
        }
        const auto foreign = options_.readMaps ? foreignNormalMaps(document_, options_.limits) : std::vector<MapSlot>();
        COTAN_TRY(dropped,
                  dropTangents(document_, options_.frames, foreign, keptTangents_, report_.decisions, report_.notes));
        report_.dropped = std::move(*dropped);
        return Done{};
    }

    // Of primitives whose tangents stay because no frame is near enough.
    void noteKeptTangents()
    {
        for (const PrimitiveDecision& d : report_.decisions)
            if (d.decision.reason == ChoiceReason::keeps && !d.decision.dropsTangents())
                report_.notes.push_back(
                    fmt::format("{}: {}", primitiveField(d.primitive.mesh, d.primitive.primitive), textOf(d.decision)));
    }

    const ConvertModelOptions& options_;
    GltfDocument& given_;
    GltfDocument document_; // a copy, so that the given document is unchanged on error
    std::optional<Scene> scene_;
    ConvertModelReport report_;
    std::vector<KeptTangents> keptTangents_;
    std::size_t surfaces_ = 0; // number over all maps
    bool named_ = false;       // the materials name the frame of their maps
};

Result<ConvertModelReport> checkedConversion(GltfDocument& document, std::optional<Scene> scene,
                                             const ConvertModelOptions& options)
{
    for (const Frame frame : {options.frames.from, options.frames.to})
        if (dependsOnView(frame))
            return usageError(
                fmt::format("convert: the frame {} depends on the view: no map can be made for it", name(frame)));
    if (options.bits != 0 && options.bits != 8 && options.bits != 16)
        return usageError(
            fmt::format("convert: expected 8 or 16 bits, or 0 for those of the old maps; found {}", options.bits));
    if (options.choose && (!options.keepMaps || !options.readMaps || options.keepTangents))
        return usageError("convert: frames are chosen for maps that are kept and read; expected keepMaps and readMaps");
    if (options.keepMaps && ((options.keepTangents && options.readMaps) || readsTangents(options.frames.to)))
        return usageError(
            fmt::format("convert: with keepMaps the tangents are dropped; expected a frame that reads none, found {}",
                        options.keepTangents ? "keepTangents" : name(options.frames.to)));
    return ModelConverter(document, std::move(scene), options).run();
}

} // namespace

Result<ConvertModelReport> convertModel(GltfDocument& document, const ConvertModelOptions& options)
{
    return checkedConversion(document, std::nullopt, options);
}

Result<ConvertModelReport> convertModel(OpenGltf& model, const ConvertModelOptions& options)
{
    return checkedConversion(model.document, std::exchange(model.scene, Scene()), options);
}

} // namespace cotan
