// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gnomon/panel/choices.hpp>
#include <gnomon/panel/figures.hpp>

#include <set>
#include <tuple>

#include <imgui.h>
#include <gnomon/shadows/detector.hpp>
#include <gnomon/ui/context.hpp>

namespace gnomon::panel {
namespace {

TEST(Figures, have_commas_between_thousands) {
    EXPECT_EQ(with_thousands(0), "0");
    EXPECT_EQ(with_thousands(999), "999");
    EXPECT_EQ(with_thousands(1000), "1,000");
    EXPECT_EQ(with_thousands(1234567), "1,234,567");
}

TEST(Reasons, that_cost_nothing_look_like_none_that_cost) {
    using shadows::Reason;
    const auto code = [](Reason reason) {
        const glm::vec4 c = color_of(reason);
        return std::tuple(c.r, c.g, c.b);
    };
    std::set<std::tuple<float, float, float>> colors;
    for (const Reason reason : {Reason::Unchanged, Reason::LightMoved, Reason::CasterMoved,
                                Reason::BothMoved, Reason::MeshChanged, Reason::New}) {
        EXPECT_TRUE(colors.insert(code(reason)).second);
    }
}

TEST(Overlays, are_switched_in_the_order_of_their_keys) {
    render::Overlays overlays;
    const auto switches = overlay_switches(overlays);
    *switches[0] = *switches[4] = true;
    EXPECT_TRUE(overlays.volumes && overlays.count);
    EXPECT_FALSE(overlays.silhouettes || overlays.caps || overlays.wireframe || overlays.fill);
}

/// Choices with a list: clicks there and then everywhere below, as somebody would who wants all.
class Choices : public testing::Test {
protected:
    template <class Choose>
    void frame(const Choose& choose) {
        context.begin_frame(input, {400, 400}, 1.0 / 60.0);
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({390, 390});
        ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoTitleBar);
        choose();
        ImGui::End();
        static_cast<void>(context.end_frame());
        input.begin_frame();
    }
    template <class Choose>
    void click(const glm::dvec2& at, const Choose& choose) {
        input.move_cursor(at);
        frame(choose);
        input.press(input::MouseButton::Left);
        frame(choose);
        input.release(input::MouseButton::Left);
        frame(choose);
        frame(choose);
    }
    ui::Context context{{.fonts = {}}};
    input::Input input;
};

TEST_F(Choices, of_strategies_are_all_there_are) {
    std::string strategy = "auto";
    int changes = 0;
    const auto choose = [&] { changes += choose_strategy(strategy) ? 1 : 0; };
    std::set<std::string> met;
    for (double y = 30.0; y < 390.0; y += 6.0) {
        click({60, 16}, choose);
        click({60, y}, choose);
        click({380, 380}, choose);  // shuts the list where it is open still
        met.insert(strategy);
    }
    std::set<std::string> all{"auto"};
    for (const auto& known : shadows::silhouette_strategies()) all.emplace(known.name);
    EXPECT_EQ(met, all);
    EXPECT_GE(changes, static_cast<int>(all.size()) - 1);
}

TEST_F(Choices, of_techniques_are_both_and_either) {
    std::optional<shadows::Technique> technique;
    const auto choose = [&] { choose_technique(technique); };
    std::set<std::optional<shadows::Technique>> met;
    for (double y = 30.0; y < 150.0; y += 6.0) {
        click({60, 16}, choose);
        click({60, y}, choose);
        click({380, 380}, choose);
        met.insert(technique);
    }
    EXPECT_EQ(met.size(), 3U);
}

TEST_F(Choices, of_views_are_met_by_a_click_each) {
    render::Overlays overlays;
    Marks marks;
    bool own = false;
    const auto show = [&] {
        show_views(overlays, marks, "Q", [&] { view_switch("own", own, "the program's own"); });
    };
    std::set<int> met;
    for (double y = 8.0; y < 150.0; y += 6.0) {
        for (const double x : {20.0, 215.0}) {
            overlays = {};
            marks = {};
            own = false;
            click({x, y}, show);
            int which = own ? 100 : 0;
            for (bool* const on : overlay_switches(overlays)) which = 2 * which + (*on ? 1 : 0);
            which = 8 * which + (marks.scissors ? 1 : 0) + (marks.reasons ? 2 : 0) +
                    (marks.probe ? 0 : 4);
            if (which != 0) met.insert(which);
        }
    }
    EXPECT_EQ(met.size(), 10U);
}

}  // namespace
}  // namespace gnomon::panel
