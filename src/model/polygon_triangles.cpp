#include "obj_text.hpp"

#include <algorithm>

#include <glm/geometric.hpp>

namespace cotan {

namespace {

using Index = std::uint32_t;

// Projects the corners along the coordinate axis nearest to the polygon's mean normal (Newell's method), such that they
// run counter-clockwise. Returns nothing if the polygon has no area.
std::vector<glm::dvec2> flatten(std::span<const glm::vec3> corners)
{
    const glm::dvec3 origin(corners[0]);
    glm::dvec3 normal(0);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        normal += glm::cross(glm::dvec3(corners[i]) - origin, glm::dvec3(corners[i + 1]) - origin);
    const glm::dvec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (!(size[axis] > 0))
        return {};
    const int first = (axis + 1) % 3, second = (axis + 2) % 3;
    std::vector<glm::dvec2> flat;
    flat.reserve(corners.size());
    for (const glm::vec3& corner : corners) {
        const glm::dvec3 p = glm::dvec3(corner) - origin;
        flat.emplace_back(p[first], p[second]);
        if (normal[axis] < 0)
            std::swap(flat.back().x, flat.back().y);
    }
    return flat;
}

// Twice the signed area of a triangle, positive if counter-clockwise.
double area2(glm::dvec2 a, glm::dvec2 b, glm::dvec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

// What an ear may contain. Each rule is tried only if the previous one finds no ear, which happens only if the polygon
// crosses or touches itself.
enum class Ear { empty, emptyInside, convex, any };

class Clipper {
public:
    Clipper(std::vector<glm::dvec2> flat, std::size_t& stepsLeft)
        : flat_(std::move(flat)), next_(flat_.size()), before_(flat_.size()), removed_(flat_.size()),
          earIndex_(flat_.size(), kNone), stepsLeft_(stepsLeft)
    {
        const auto n = Index(flat_.size());
        for (Index i = 0; i < n; ++i) {
            next_[i] = (i + 1) % n;
            before_[i] = (i + n - 1) % n;
        }
        for (Index i = 0; i < n; ++i)
            if (!(area2At(i) > 0))
                notConvex_.push_back(i);
        std::ranges::sort(notConvex_, {}, [&](Index i) { return flat_[i].x; });
    }

    bool isConvex() const { return notConvex_.empty(); }

    // Appends the triangles. An ear stays an ear until it or a neighbour is clipped, and other corners become ears only
    // when a neighbour is clipped. So each corner is tested once, and two more per clipped corner.
    bool cut(std::vector<Index>& triangles)
    {
        std::size_t corners = flat_.size(), first = 0;
        Index last = 0; // any remaining corner
        while (corners > 3) {
            if (first == ears_.size() && !findEars(last, corners))
                return false;
            const Index at = ears_[first];
            if (earIndex_[at] != first++)
                continue; // tested again after a neighbour was clipped
            triangles.insert(triangles.end(), {before_[at], at, next_[at]});
            clip(at);
            --corners;
            last = next_[at];
            for (const Index beside : {before_[at], next_[at]})
                testEar(beside, Ear::empty);
            if (stepsLeft_ == 0)
                return false;
        }
        triangles.insert(triangles.end(), {before_[last], last, next_[last]});
        return true;
    }

private:
    static constexpr std::size_t kNone = ~std::size_t(0);

    double area2At(Index i) const { return area2(flat_[before_[i]], flat_[i], flat_[next_[i]]); }

    // Appends the corner to the list of ears if it is one.
    bool testEar(Index i, Ear ear)
    {
        const bool found = isEar(i, ear);
        earIndex_[i] = found ? ears_.size() : kNone;
        if (found)
            ears_.push_back(i);
        return found;
    }

    // Tests all remaining corners, with the first rule that finds an ear.
    bool findEars(Index start, std::size_t corners)
    {
        for (Ear ear = Ear::empty; stepsLeft_ > 0; ear = Ear(int(ear) + 1)) {
            bool found = false;
            Index at = start;
            for (std::size_t i = 0; i < corners && stepsLeft_ > 0; ++i, at = next_[at]) {
                found = testEar(at, ear) || found;
                if (found && ear != Ear::empty)
                    break; // after clipping it, the others may be no ears any more
            }
            if (found)
                return true;
        }
        return false;
    }

    void clip(Index i)
    {
        removed_[i] = true;
        next_[before_[i]] = next_[i];
        before_[next_[i]] = before_[i];
        if (++clipped_ * 4 > notConvex_.size()) {
            std::erase_if(notConvex_, [&](Index k) { return removed_[k] || area2At(k) > 0; });
            clipped_ = 0;
        }
    }

    bool isEar(Index i, Ear ear)
    {
        stepsLeft_ -= std::min<std::size_t>(stepsLeft_, 1);
        if (ear == Ear::any)
            return true;
        if (!(area2At(i) > 0))
            return false;
        return ear == Ear::convex || !anyInside(i, /*rimToo*/ ear == Ear::empty);
    }

    // Whether a reflex or straight corner lies in the ear at i. If any corner lies in it, one of these does. Corners
    // that coincide with one of the ear's are ignored.
    bool anyInside(Index i, bool rimToo)
    {
        const glm::dvec2 a = flat_[before_[i]], b = flat_[i], c = flat_[next_[i]];
        const glm::dvec2 low = glm::min(glm::min(a, b), c), high = glm::max(glm::max(a, b), c);
        auto at = std::ranges::lower_bound(notConvex_, low.x, {}, [&](Index k) { return flat_[k].x; });
        for (; at != notConvex_.end() && stepsLeft_ > 0; ++at, --stepsLeft_) {
            const glm::dvec2 p = flat_[*at];
            if (p.x > high.x)
                return false;
            if (p.y < low.y || p.y > high.y || p == a || p == b || p == c)
                continue;
            const double nearest = std::min({area2(a, b, p), area2(b, c, p), area2(c, a, p)});
            // As the polygon shrinks, corners become convex or are removed.
            if ((nearest > 0 || (rimToo && nearest == 0)) && !removed_[*at] && !(area2At(*at) > 0))
                return true;
        }
        return false;
    }

    std::vector<glm::dvec2> flat_;
    std::vector<Index> next_, before_;
    std::vector<bool> removed_;
    std::vector<Index> notConvex_;      // by x; some may have become convex or been removed
    std::vector<Index> ears_;           // to be clipped, in this order
    std::vector<std::size_t> earIndex_; // index in ears_ of each corner; kNone: no ear
    std::size_t clipped_ = 0;           // since notConvex_ was last cleaned
    std::size_t& stepsLeft_;
};

} // namespace

bool cutPolygon(std::span<const glm::vec3> corners, std::vector<Index>& triangles, std::size_t& stepsLeft)
{
    std::vector<glm::dvec2> flat;
    if (corners.size() > 3)
        flat = flatten(corners);
    if (!flat.empty())
        if (Clipper clipper(std::move(flat), stepsLeft); !clipper.isConvex())
            return clipper.cut(triangles);
    for (Index i = 1; i + 1 < corners.size(); ++i)
        triangles.insert(triangles.end(), {0, i, i + 1});
    return true;
}

} // namespace cotan
