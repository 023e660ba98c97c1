// Poses a model at a time of an animation, and bounds the motion of animations.
#include "gltf_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/one_line.hpp"
#include "core/parse_number.hpp"
#include "core/try.hpp"
#include "scene/geometry.hpp"

namespace cotan {

namespace {

using gltf::Accessor, gltf::Choice, gltf::ElementType, gltf::Json;

// A time relative to the keys of a channel.
struct Moment {
    std::size_t key = 0, next = 0; // equal before the first and after the last key
    double fraction = 0;           // 0 to 1 between the keys
    double seconds = 0;            // from key to next
};

// The values of a channel around a time, each `width` numbers: two keys and the tangents between them.
struct KeyValues {
    std::vector<double> value, next, outTangent, inTangent;
};

class Poser {
public:
    Poser(GltfModel& model, std::size_t animation) : model_(model), number_(animation) {}

    void run()
    {
        const Json& animation = model_.file.json["animations"][number_];
        for (std::size_t c = 0; c < animation["channels"].size(); ++c) {
            const Json& channel = animation["channels"][c];
            const Json& target = channel["target"];
            field_ = fmt::format("animations[{}].channels[{}]", number_, c);
            const int node = gltf::valueOr(target, "node", -1);
            const auto sampler = channel["sampler"].get<std::size_t>();
            if (sampler >= animation["samplers"].size())
                failGltf("{}.sampler: expected an index below {}, the number of samplers, found {}", field_,
                         animation["samplers"].size(), sampler);
            if (node >= 0)
                pose(model_.structure.nodes[std::size_t(node)], target["path"].get_ref<const std::string&>(),
                     animation["samplers"][sampler]);
        }
    }

private:
    void pose(gltf::Node& node, std::string_view path, const Json& sampler)
    {
        if (path == "weights") {
            node.weights = values(sampler, ElementType::scalar, targetsOf(node), false);
            return;
        }
        const bool rotation = path == "rotation";
        if (!rotation && path != "translation" && path != "scale") {
            model_.warnings.add(field_, fmt::format("animation of the path \"{}\" is not supported", oneLine(path)));
            return;
        }
        if (node.matrix)
            failGltf("{}.target: the node has a matrix, which cannot be animated", field_);
        const std::vector<double> v = values(sampler, rotation ? ElementType::vec4 : ElementType::vec3, 1, rotation);
        if (rotation)
            node.rotation = {v[0], v[1], v[2], v[3]};
        else
            (path == "scale" ? node.scale : node.translation) = glm::dvec3(v[0], v[1], v[2]);
    }

    std::size_t targetsOf(const gltf::Node& node) const
    {
        if (node.mesh < 0 || model_.structure.meshes[std::size_t(node.mesh)].primitives.empty())
            return 0;
        return model_.structure.meshes[std::size_t(node.mesh)].primitives[0].targets.size();
    }

    std::vector<float> read(int accessor, const Choice& choice, std::size_t width)
    {
        takeGltfBytes(model_, std::uint64_t(choice.size()) * width * sizeof(float), field_);
        std::vector<float> numbers(choice.size() * width);
        if (!numbers.empty())
            gltf::readNumbers(model_.accessors[std::size_t(accessor)], choice, width, numbers.data());
        return numbers;
    }

    Moment momentOf(int input)
    {
        const Accessor& a = model_.accessors[std::size_t(input)].accessor;
        if (a.type != ElementType::scalar || a.componentType != gltf::kFloat || a.count == 0)
            failGltf("{}: expected floats in accessors[{}] for the key times", field_, input);
        const std::vector<float> times = read(input, a.count, 1);
        for (std::size_t i = 1; i < times.size(); ++i)
            if (!(times[i] > times[i - 1]))
                failGltf("{}: expected ascending times in accessors[{}], found {} after {}", field_, input, times[i],
                         times[i - 1]);
        const double now = model_.limits.pose.seconds;
        const auto after = std::upper_bound(times.begin(), times.end(), now);
        if (after == times.begin())
            return {};
        const std::size_t key = std::size_t(after - times.begin()) - 1;
        if (after == times.end())
            return {key, key, 0, 0};
        const double seconds = double(*after) - double(times[key]);
        return {key, key + 1, (now - double(times[key])) / seconds, seconds};
    }

    // perKey: number of elements per key.
    KeyValues readKeys(int output, const Moment& at, std::size_t keys, std::size_t perKey, ElementType type, bool cubic)
    {
        const Accessor& a = model_.accessors[std::size_t(output)].accessor;
        const std::size_t parts = cubic ? 3 : 1, width = gltf::componentCount(type);
        gltf::expectElements(a, type, std::uint64_t(keys) * perKey * parts, {output, field_});
        if (a.componentType == gltf::kUnsignedInt || (a.componentType != gltf::kFloat && !a.normalized))
            failGltf("{}: expected floats or normalized integers in accessors[{}], found {}", field_, output,
                     gltf::nameOfComponent(a.componentType));
        // Cubic keys store in-tangent, value and out-tangent; the tangents used are the first key's out and the next
        // one's in.
        const auto elements = [&](std::size_t key, std::size_t part) {
            std::vector<std::uint32_t> chosen(perKey);
            for (std::size_t i = 0; i < perKey; ++i)
                chosen[i] = std::uint32_t((key * parts + part) * perKey + i);
            const std::vector<float> read4 = read(output, Choice(a.count, chosen), width);
            return std::vector<double>(read4.begin(), read4.end());
        };
        if (!cubic)
            return {elements(at.key, 0), elements(at.next, 0), {}, {}};
        return {elements(at.key, 1), elements(at.next, 1), elements(at.key, 2), elements(at.next, 0)};
    }

    std::vector<double> values(const Json& sampler, ElementType type, std::size_t perKey, bool rotation)
    {
        const std::string interpolation = gltf::valueOr(sampler, "interpolation", std::string("LINEAR"));
        const bool cubic = interpolation == "CUBICSPLINE";
        const int input = sampler["input"].get<int>();
        const Moment at = momentOf(input);
        const KeyValues v = readKeys(sampler["output"].get<int>(), at,
                                     model_.accessors[std::size_t(input)].accessor.count, perKey, type, cubic);
        if (at.key == at.next || interpolation == "STEP")
            return v.value;
        if (rotation && !cubic)
            return slerped(v.value, v.next, at.fraction);
        std::vector<double> now(v.value.size());
        const double t = at.fraction, t2 = t * t, t3 = t2 * t;
        for (std::size_t i = 0; i < now.size(); ++i)
            if (cubic)
                now[i] = (2 * t3 - 3 * t2 + 1) * v.value[i] + (t3 - 2 * t2 + t) * at.seconds * v.outTangent[i]
                    + (3 * t2 - 2 * t3) * v.next[i] + (t3 - t2) * at.seconds * v.inTangent[i];
            else
                now[i] = v.value[i] + (v.next[i] - v.value[i]) * t;
        if (rotation) // a spline leaves the unit sphere between its keys (appendix C)
            if (const double length = glm::length(glm::dvec4(now[0], now[1], now[2], now[3])); length > 0)
                for (double& x : now)
                    x /= length;
        return now;
    }

    static std::vector<double> slerped(const std::vector<double>& from, const std::vector<double>& to, double fraction)
    {
        const glm::dquat a = glm::normalize(glm::dquat(from[3], from[0], from[1], from[2]));
        const glm::dquat b = glm::normalize(glm::dquat(to[3], to[0], to[1], to[2]));
        const glm::dquat q = glm::slerp(a, b, fraction); // along the shorter arc
        return {q.x, q.y, q.z, q.w};
    }

    GltfModel& model_;
    std::size_t number_;
    std::string field_;
};

// The names as in the file, which are not checked yet; empty if a name is not a string.
std::vector<std::string> animationNames(const Json& root)
{
    return gltf::readAll(&root, "animations", [](const Json& a) {
        const Json* const name = gltf::member(a, "name");
        return name && name->is_string() ? name->get<std::string>() : std::string();
    });
}

// Time of the last key in seconds; 0 if the accessor does not hold times.
double lastKey(const GltfModel& model, int input)
{
    const gltf::Elements& times = model.accessors[std::size_t(input)];
    const Accessor& a = times.accessor;
    if (a.type != ElementType::scalar || a.componentType != gltf::kFloat || a.count == 0)
        return 0;
    float last = 0;
    const std::vector<std::uint32_t> chosen = {std::uint32_t(a.count - 1)};
    gltf::readNumbers(times, Choice(a.count, chosen), 1, &last);
    return std::max(double(last), 0.0);
}

// ---- bounds of an animation -----------------------------------------------------------------

constexpr double kMomentsASecond = 30;
constexpr std::size_t kMaxMoments = 256, kMinMoments = 9;
constexpr std::size_t kMaxPosed = 8'000'000; // vertices over all moments
constexpr std::size_t kMaxKept = 300'000;    // points
constexpr std::size_t kDirections = 64;

// Unit vectors evenly over a half sphere; their opposites complete it (R. Swinbank, R. J. Purser, Fibonacci grids,
// 2006).
std::array<glm::vec3, kDirections> directions()
{
    std::array<glm::vec3, kDirections> all;
    for (std::size_t i = 0; i < kDirections; ++i) {
        const float z = 1 - (float(i) + 0.5f) / float(kDirections), side = std::sqrt(1 - z * z);
        const float angle = 2.399963f * float(i);
        all[i] = {side * std::cos(angle), side * std::sin(angle), z};
    }
    return all;
}

void addAll(const Scene& scene, std::vector<glm::vec3>& points)
{
    forEachPlacedPoint(
        scene, [&](const glm::mat4& toWorld, const glm::vec3& p) { points.emplace_back(toWorld * glm::vec4(p, 1)); });
}

// Appends the extreme points in both senses of each direction.
void addFurthest(const Scene& scene, std::vector<glm::vec3>& points)
{
    static const std::array<glm::vec3, kDirections> kAlong = directions();
    struct Furthest {
        float low = std::numeric_limits<float>::infinity(), high = -std::numeric_limits<float>::infinity();
        glm::vec3 lowest{0}, highest{0};
    };
    std::array<Furthest, kDirections> found;
    forEachPlacedPoint(scene, [&](const glm::mat4& toWorld, const glm::vec3& p) {
        const glm::vec3 world(toWorld * glm::vec4(p, 1));
        for (std::size_t i = 0; i < kDirections; ++i) {
            const float far = glm::dot(world, kAlong[i]);
            if (far < found[i].low)
                found[i].low = far, found[i].lowest = world;
            if (far > found[i].high)
                found[i].high = far, found[i].highest = world;
        }
    });
    for (const Furthest& f : found)
        if (f.low <= f.high)
            points.insert(points.end(), {f.lowest, f.highest});
}

std::size_t verticesPlaced(const Scene& scene)
{
    std::size_t count = 0;
    for (const Instance& instance : scene.instances)
        if (const Mesh* mesh = meshPlacedBy(scene, instance))
            count += mesh->vertexCount();
    return count;
}

double secondsOf(const AnimatedGltf& model, const std::string& animation)
{
    const auto& all = model.animations();
    const auto named = std::ranges::find(all, animation, &GltfAnimation::name);
    if (named != all.end())
        return named->seconds;
    std::size_t number = 0;
    return parseNumber(std::string_view(animation), number) && number < all.size() ? all[number].seconds : 0;
}

} // namespace

std::vector<GltfAnimation> gltfAnimations(GltfModel& model)
{
    const Json* const list = gltf::member(model.file.json, "animations");
    std::vector<GltfAnimation> all;
    for (const std::string& name : animationNames(model.file.json))
        all.push_back({oneLine(name), 0});
    try {
        checkGltfAnimations(model.file.json);
    } catch (const GltfProblem&) {
        return all;
    }
    for (std::size_t i = 0; i < all.size(); ++i)
        for (const Json& sampler : (*list)[i]["samplers"])
            all[i].seconds = std::max(all[i].seconds, lastKey(model, sampler["input"].get<int>()));
    return all;
}

void poseGltf(GltfModel& model)
{
    if (model.limits.pose.animation.empty())
        return;
    const std::size_t animation = findNamed(animationNames(model.file.json), model.limits.pose.animation, "animations");
    checkGltfAnimations(model.file.json);
    Poser(model, animation).run();
}

Result<std::vector<glm::vec3>> pointsReached(AnimatedGltf& model, const std::string& animation)
{
    const double seconds = secondsOf(model, animation);
    std::vector<glm::vec3> points;
    std::size_t moments = 1, vertices = 0;
    for (std::size_t i = 0; i < moments; ++i) {
        const double fraction = moments > 1 ? double(i) / double(moments - 1) : 0;
        COTAN_TRY(scene, model.at({animation, seconds * fraction}));
        if (i == 0 && seconds > 0) {
            vertices = std::max<std::size_t>(verticesPlaced(*scene), 1);
            const std::size_t affordable = std::clamp(kMaxPosed / vertices, kMinMoments, kMaxMoments);
            moments = std::min(affordable, std::size_t(std::min(seconds * kMomentsASecond, 1e6)) + 2);
        }
        if (vertices * moments <= kMaxKept)
            addAll(*scene, points);
        else
            addFurthest(*scene, points);
    }
    return points;
}

} // namespace cotan
