// Input events, each on its own, with different numbers along x and y, and both sides of each limit.
#include <gtest/gtest.h>

#include <cmath>

#include <glm/geometric.hpp>

#include "camera.hpp"
#include "viewer_camera_cases.hpp"
#include "viewer_state.hpp"

namespace cotan::viewer {
namespace {

TEST(ViewerDrag, aPixelOrbitsTheEyeByAThirdOfADegree)
{
    State state = builtIn();
    state.camera = levelCamera();
    send(state, "0 move 100 100\npress left\nmove 140 120\n");
    const glm::vec2 angles = anglesFrom(state.camera);
    EXPECT_NEAR(angles.x, -40 * 0.35f, 1e-3f);
    EXPECT_NEAR(angles.y, 20 * 0.35f, 1e-3f);
    EXPECT_EQ(state.camera.target, glm::vec3(0));
    EXPECT_EQ(state.pointer, glm::vec2(140, 120));
    EXPECT_EQ(state.picture.environmentRotation, builtIn().picture.environmentRotation);
}

TEST(ViewerDrag, eachButtonHasItsMeaning)
{
    for (const char* button : {"right", "middle", "ctrl+left"}) {
        State state = builtIn();
        state.camera = levelCamera();
        const float unit = unitsOfPixel(state.camera, 5, state.size);
        send(state, std::string("0 move 100 100\npress ") + button + "\nmove 140 120\n");
        expectClose(state.camera.target, {-40 * unit, 20 * unit, 0}, 1e-4f);
        expectClose(state.camera.eye, {-40 * unit, 20 * unit, 5}, 1e-4f);
        EXPECT_TRUE(state.moving) << button;
        EXPECT_TRUE(state.cameraMoved) << button;
    }
}

TEST(ViewerDrag, theRightButtonWithAKeyLooksAround)
{
    State state = builtIn();
    state.camera = levelCamera();
    send(state, "0 move 100 100\npress right\nkey w\nmove 140 120\n");
    expectClose(state.camera.eye, {0, 0, 5}, 1e-6f);
    const glm::vec3 to = glm::normalize(state.camera.target - state.camera.eye);
    EXPECT_NEAR(std::atan2(to.x, -to.z) * kDegreesOfRadian, 40 * 0.35f, 1e-3f); // to the right
    EXPECT_NEAR(std::asin(to.y) * kDegreesOfRadian, -20 * 0.35f, 1e-3f);        // and down
}

TEST(ViewerDrag, fourPixelsAreAClickAndFiveADrag)
{
    for (const auto& [pixels, drags] : {std::pair(4, false), {5, true}}) {
        State state = builtIn();
        const Camera before = state.camera;
        send(state, "0 move 100 100\npress left\nmove 100 " + std::to_string(100 + pixels) + "\n");
        EXPECT_EQ(state.dragged, drags) << pixels;
        EXPECT_EQ(state.camera.eye != before.eye, drags) << pixels;
    }
}

TEST(ViewerDrag, endsWithItsButton)
{
    State state = builtIn();
    send(state, "0 move 100 100\npress left\nmove 200 100\nrelease left\nmove 640 400\npress left\n");
    EXPECT_FALSE(state.dragged);
    EXPECT_EQ(state.pressedAt, glm::vec2(640, 400));
    EXPECT_EQ(state.held, "left");
    const glm::vec3 eye = state.camera.eye;
    send(state, "0 release left\n"); // a click, although the previous one was a drag
    EXPECT_EQ(state.camera.eye, eye);
    EXPECT_TRUE(state.held.empty());
}

TEST(ViewerDrag, aClickOfAnotherButtonOrBesideTheModelKeepsThePivot)
{
    for (const char* click :
         {"0 move 640 400\npress right\nrelease right\n", "0 move 640 400\npress middle\nrelease middle\n",
          "0 move 3 3\npress left\nrelease left\n"}) {
        State state = builtIn();
        state.cameraMoved = false;
        const glm::vec3 pivot = state.camera.target;
        send(state, click);
        EXPECT_EQ(state.camera.target, pivot) << click;
        EXPECT_FALSE(state.cameraMoved) << click;
    }
    State state = builtIn();
    state.cameraMoved = false;
    send(state, "0 move 640 400\npress left\nrelease left\n");
    EXPECT_TRUE(state.cameraMoved);
}

TEST(ViewerDivider, isGrabbedWithinEightPixelsByTheLeftButton)
{
    struct Case {
        const char* compare;
        float fraction, x;
        const char* button;
        bool held;
    };
    for (const Case& c : {Case{"divider", 0.25f, 328, "left", true}, Case{"divider", 0.25f, 329, "left", false},
                          Case{"divider", 0.25f, 312, "left", true}, Case{"divider", 0.25f, 311, "left", false},
                          Case{"divider", 0.25f, 320, "right", false}, Case{"divider", 0.25f, 320, "shift+left", true},
                          Case{"flip", 0.25f, 320, "left", false}, Case{"off", 0.25f, 320, "left", false}}) {
        State state = builtIn();
        send(state, std::string("0 do compare ") + c.compare + "\n");
        state.divider = c.fraction;
        send(state, fmt::format("0 move {} 700\npress {}\n", c.x, c.button));
        EXPECT_EQ(state.holdsDivider, c.held) << c.compare << ' ' << c.x << ' ' << c.button;
    }
}

TEST(ViewerDivider, followsThePointerUntilReleased)
{
    State state = builtIn();
    send(state, "0 do compare divider\nmove 641 700\npress left\nmove 642 10\n");
    EXPECT_NEAR(state.divider, 642.0f / 1280, 1e-6f);
    EXPECT_FALSE(state.moving);
    send(state, "0 move -30 10\n");
    EXPECT_EQ(state.divider, 0.0f);
    const glm::vec3 pivot = state.camera.target;
    send(state, "0 move 640 400\nrelease left\n");
    EXPECT_EQ(state.camera.target, pivot); // not a click
    EXPECT_FALSE(state.holdsDivider);
    send(state, "0 move 900 400\n");
    EXPECT_EQ(state.divider, 0.5f);
}

TEST(ViewerWheel, aStepZoomsByFifteenPercentUpToTwentySteps)
{
    for (const auto& [steps, factor] : {std::pair(1.0f, 0.85),
                                        {-1.0f, 1 / 0.85},
                                        {2.5f, std::pow(0.85, 2.5)},
                                        {20.0f, std::pow(0.85, 20)},
                                        {21.0f, std::pow(0.85, 20)},
                                        {-20.0f, std::pow(0.85, -20)},
                                        {-21.0f, std::pow(0.85, -20)}}) {
        State state = builtIn();
        state.camera = levelCamera();
        state.cameraMoved = false;
        state.pointer = glm::vec2(state.size) * 0.5f;
        send(state, fmt::format("0 scroll 3 {}\n", steps));
        EXPECT_NEAR(glm::length(state.camera.eye - state.camera.target), 5 * factor, 5e-5 * factor) << steps;
        expectClose(state.camera.target, {0, 0, 0}, 1e-5f);
        EXPECT_TRUE(state.cameraMoved);
    }
}

TEST(ViewerFlying, eachKeyHasItsDirectionAndOppositeKeysCancel)
{
    struct Case {
        const char* keys;
        glm::vec3 to;
    };
    for (const Case& c : {Case{"w", {0, 0, -1}}, Case{"s", {0, 0, 1}}, Case{"a", {-1, 0, 0}}, Case{"d", {1, 0, 0}},
                          Case{"q", {0, -1, 0}}, Case{"e", {0, 1, 0}}, Case{"ws", {0, 0, 0}}, Case{"de", {1, 1, 0}}}) {
        State state = builtIn();
        state.camera = levelCamera();
        state.speed = 0.25f;
        state.cameraMoved = state.moving = false;
        send(state, "0 press right\n");
        for (const char key : std::string(c.keys))
            send(state, std::string("0 key ") + key + "\n");
        advance(state, 0.5);
        const float size = glm::length(state.model->box.high - state.model->box.low);
        expectClose(state.camera.eye, glm::vec3(0, 0, 5) + c.to * size * 0.125f, 1e-4f * size);
        expectClose(state.camera.target, c.to * size * 0.125f, 1e-4f * size);
        EXPECT_TRUE(state.cameraMoved && state.moving) << c.keys;
    }
}

TEST(ViewerFlying, keysCountOnceAndOnlyWithTheRightButton)
{
    State state = builtIn();
    send(state, "0 press right\nkey w\nkey w\nkey shift+d\nkey x\n");
    EXPECT_EQ(state.keysDown, (std::vector<std::string>{"w", "d"}));
    send(state, "0 keyup w\n");
    EXPECT_EQ(state.keysDown, std::vector<std::string>{"d"});
    send(state, "0 release right\n");
    const glm::vec3 eye = state.camera.eye;
    advance(state, 1);
    EXPECT_EQ(state.camera.eye, eye);
    State other = builtIn();
    send(other, "0 press left\nkey w\n");
    EXPECT_TRUE(other.keysDown.empty());
}

TEST(ViewerTime, advancesByTheRateOnlyWhilePlaying)
{
    State state = builtIn();
    state.picture.time = 1;
    state.rate = 0.5f;
    advance(state, 3);
    EXPECT_EQ(state.picture.time, 1.0);
    EXPECT_TRUE(state.requests.empty());
    state.playing = true;
    advance(state, 0);
    EXPECT_EQ(state.picture.time, 1.0);
    EXPECT_TRUE(state.requests.empty());
    advance(state, 3);
    EXPECT_EQ(state.picture.time, 2.5);
    ASSERT_EQ(state.requests.size(), 1u);
    EXPECT_TRUE(std::holds_alternative<request::Pose>(state.requests[0]));
}

TEST(ViewerWindowSize, followsTheResizeEvent)
{
    State state = builtIn();
    send(state, "0 resize 321.7 123\n");
    EXPECT_EQ(state.size, glm::ivec2(321, 123));
}

TEST(ViewerProblems, areClearedByTheNextCommandButNotByAReport)
{
    State state = builtIn();
    state.message = "something";
    send(state, "0 do frame nonsense\n");
    const std::string problem = state.problem;
    EXPECT_NE(problem.find("nonsense"), std::string::npos);
    EXPECT_EQ(state.message, "something");
    send(state, "0 do report a.txt\ndo window b.png\n");
    EXPECT_EQ(state.problem, problem);
    EXPECT_EQ(state.message, "something");
    send(state, "0 do orbit 1 0\n");
    EXPECT_EQ(state.problem, "");
    EXPECT_EQ(state.message, "");
}

TEST(ViewerClosing, closeAndDropEventsBecomeRequests)
{
    State state = builtIn();
    send(state, "0 close\n");
    ASSERT_FALSE(state.requests.empty());
    EXPECT_TRUE(std::holds_alternative<request::Quit>(state.requests.back()));
    State other = builtIn();
    send(other, "0 drop /some/a b.glb\n");
    ASSERT_FALSE(other.requests.empty());
    EXPECT_EQ(std::get<request::Load>(other.requests.back()).model, "/some/a b.glb");
}

} // namespace
} // namespace cotan::viewer
