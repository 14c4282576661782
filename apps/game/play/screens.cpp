// SPDX-License-Identifier: MIT
#include "play/screens.hpp"

#include <algorithm>
#include <utility>

#include <gnomon/core/expects.hpp>

namespace gnomon::game {

Screens::Screens(ScreensDesc desc) : desc_(std::move(desc)), watches_(desc_.watches) {
    GNOMON_EXPECTS(desc_.levels > 0);
    show(Screen::Title);
}

void Screens::show(Screen screen) {
    using Kind = MenuItem::Kind;
    now_ = screen;
    selected_ = 0;
    items_.clear();
    switch (screen) {
        case Screen::Title:
            for (std::size_t i = 0; i < desc_.levels; ++i) {
                items_.push_back(MenuItem{Kind::Level, i});
            }
            if (desc_.can_watch) items_.push_back(MenuItem{Kind::Watch});
            items_.push_back(MenuItem{Kind::Settings});
            if (desc_.can_quit) items_.push_back(MenuItem{Kind::Quit});
            selected_ = level_;
            break;
        case Screen::Playing: break;
        case Screen::Paused:
            items_.push_back(MenuItem{Kind::Resume});
            if (!watches_) items_.push_back(MenuItem{Kind::Restart});
            items_.push_back(MenuItem{Kind::Settings});
            items_.push_back(MenuItem{desc_.watches ? Kind::Quit : Kind::ToTitle});
            break;
        case Screen::Won:
            if (level_ + 1 < desc_.levels) items_.push_back(MenuItem{Kind::NextLevel});
            items_.push_back(MenuItem{Kind::Restart});
            items_.push_back(MenuItem{Kind::ToTitle});
            break;
        case Screen::Caught:
            items_.push_back(MenuItem{Kind::Restart});
            items_.push_back(MenuItem{Kind::ToTitle});
            break;
        case Screen::Settings:
            for (const Setting setting : desc_.settings) {
                items_.push_back({.kind = Kind::Setting, .setting = setting});
            }
            items_.push_back(MenuItem{Kind::Back});
            break;
    }
}

void Screens::begin(std::size_t level) {
    GNOMON_EXPECTS(level < desc_.levels);
    level_ = level;
    show(Screen::Playing);
}

Order Screens::watch() {
    GNOMON_EXPECTS(desc_.can_watch);
    watches_ = true;
    show(Screen::Playing);
    return {.kind = Order::Kind::Watch, .level = level_};
}

void Screens::ended(Outcome outcome) {
    if (now_ != Screen::Playing || watches_) return;
    if (outcome == Outcome::Won) show(Screen::Won);
    if (outcome == Outcome::Caught) show(Screen::Caught);
}

Order Screens::leave() {
    watches_ = desc_.watches;
    show(Screen::Title);
    return {.kind = Order::Kind::Leave};
}

Order Screens::close_settings() {
    show(behind_);
    const auto opened_by = std::ranges::find(items_, MenuItem{MenuItem::Kind::Settings});
    if (opened_by != items_.end()) {
        selected_ = static_cast<std::size_t>(opened_by - items_.begin());
    }
    return {.kind = Order::Kind::Save};
}

Order Screens::accept() {
    const MenuItem item = items_[selected_];
    switch (item.kind) {
        case MenuItem::Kind::Level:
            begin(item.level);
            return {.kind = Order::Kind::Begin, .level = item.level};
        case MenuItem::Kind::Watch: return watch();
        case MenuItem::Kind::NextLevel:
            begin(level_ + 1);
            return {.kind = Order::Kind::Begin, .level = level_};
        case MenuItem::Kind::Resume: show(Screen::Playing); return {};
        case MenuItem::Kind::Restart: show(Screen::Playing); return {.kind = Order::Kind::Restart};
        case MenuItem::Kind::Settings:
            behind_ = now_;
            show(Screen::Settings);
            return {};
        case MenuItem::Kind::Setting:
            return {.kind = Order::Kind::Change, .setting = item.setting, .by = 1};
        case MenuItem::Kind::Back: return close_settings();
        case MenuItem::Kind::ToTitle: return leave();
        case MenuItem::Kind::Quit: return {.kind = Order::Kind::Quit};
    }
    return {};
}

Order Screens::press(const MenuPress& press) {
    if (now_ == Screen::Playing) {
        // Who watches is not needed.
        if (press.pause || (press.interrupted && !watches_)) {
            show(Screen::Paused);
        } else if (press.restart && !watches_) {
            return {.kind = Order::Kind::Restart};
        }
        return {};
    }
    const std::size_t count = items_.size();
    if (press.pointed && *press.pointed < count) selected_ = *press.pointed;
    if (press.down > 0) selected_ = (selected_ + 1) % count;
    if (press.down < 0) selected_ = (selected_ + count - 1) % count;
    if (now_ == Screen::Title && items_[selected_].kind == MenuItem::Kind::Level) {
        level_ = items_[selected_].level;
    }
    if (press.accept) return accept();
    const bool is_over = now_ == Screen::Won || now_ == Screen::Caught;
    if (press.restart && (is_over || (now_ == Screen::Paused && !watches_))) {
        show(Screen::Playing);
        return {.kind = Order::Kind::Restart};
    }
    if (now_ == Screen::Settings) {
        const MenuItem& item = items_[selected_];
        if (press.back) return close_settings();
        if (press.right != 0 && item.kind == MenuItem::Kind::Setting) {
            return {.kind = Order::Kind::Change, .setting = item.setting, .by = press.right};
        }
    } else if (now_ == Screen::Paused && (press.back || press.pause)) {
        show(Screen::Playing);
    } else if (is_over && press.back) {
        return leave();
    } else if (now_ == Screen::Title && press.back) {
        // Nobody quits by one key too many.
        selected_ = count - 1;
    }
    return {};
}

}  // namespace gnomon::game
