// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <imgui.h>
#include <gnomon/ui/context.hpp>

namespace gnomon::ui {
namespace {

using input::Key;
using input::MouseButton;

class UiContext : public testing::Test {
protected:
    // A window in the upper left quarter with one button and one field.
    void frame() {
        context.begin_frame(input, {400, 300}, 1.0 / 60.0);
        ImGui::SetNextWindowPos({0, 0});
        ImGui::SetNextWindowSize({200, 150});
        ImGui::Begin("panel", nullptr, ImGuiWindowFlags_NoTitleBar);
        clicked = ImGui::Button("push", {100, 40});
        clicks += clicked ? 1 : 0;
        ImGui::InputText("##field", text, sizeof text);
        ImGui::End();
        static_cast<void>(context.end_frame());
        input.begin_frame();
    }
    Context context{{.fonts = {}}};
    input::Input input;
    bool clicked = false;
    int clicks = 0;
    char text[32] = "";
};

TEST_F(UiContext, a_click_within_one_frame_pushes_a_button_once) {
    input.move_cursor({40, 30});
    frame();
    frame();
    EXPECT_TRUE(context.wants_mouse());
    input.press(MouseButton::Left);
    input.release(MouseButton::Left);
    for (int i = 0; i < 4; ++i) frame();
    EXPECT_EQ(clicks, 1);
}

TEST_F(UiContext, the_mouse_beside_the_panel_is_the_scenes) {
    input.move_cursor({300, 200});
    for (int i = 0; i < 3; ++i) frame();
    EXPECT_FALSE(context.wants_mouse());
    input.press(MouseButton::Left);
    frame();
    input.move_cursor({40, 30});
    frame();
    EXPECT_FALSE(context.wants_mouse()) << "what began in the scene goes on there";
    EXPECT_EQ(clicks, 0);
}

TEST_F(UiContext, what_is_typed_arrives) {
    input.move_cursor({40, 65});
    frame();
    frame();
    EXPECT_FALSE(context.wants_keyboard());
    input.press(MouseButton::Left);
    input.release(MouseButton::Left);
    for (int i = 0; i < 3; ++i) frame();
    EXPECT_TRUE(context.wants_keyboard());
    input.text = U"gnomon";
    frame();
    EXPECT_STREQ(text, "gnomon");
    input.press(Key::Backspace);
    frame();
    EXPECT_STREQ(text, "gnomo");
    frame();
    EXPECT_STREQ(text, "gnomo");
    input.repeat(Key::Backspace);
    frame();
    EXPECT_STREQ(text, "gnom");
    frame();
    EXPECT_STREQ(text, "gnom");
}

TEST_F(UiContext, a_frame_that_was_given_up_does_not_hinder_the_next) {
    context.begin_frame(input, {400, 300}, 1.0 / 60.0);
    ImGui::Begin("never drawn");
    ImGui::End();
    input.move_cursor({40, 30});
    frame();
    frame();
    input.press(MouseButton::Left);
    input.release(MouseButton::Left);
    for (int i = 0; i < 4; ++i) frame();
    EXPECT_EQ(clicks, 1);
}

TEST_F(UiContext, an_unreadable_font_is_replaced) {
    Context other({.fonts = {"/there/is/no/such.ttf"}});
    other.begin_frame(input, {100, 100}, 0.0);
    ImGui::TextUnformatted("text");
    EXPECT_GT(other.end_frame().TotalVtxCount, 0);
}

}  // namespace
}  // namespace gnomon::ui
