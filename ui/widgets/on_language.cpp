#include "ui/widgets/on_language.h"

namespace zerodrift::ui {
namespace {

class LanguageWatch : public QObject {
 public:
  LanguageWatch(QWidget* widget, std::function<void()> say) : QObject(widget), m_say(std::move(say)) {
    widget->installEventFilter(this);
  }

  bool eventFilter(QObject* watched, QEvent* event) override {
    if (event->type() == QEvent::LanguageChange) m_say();
    return QObject::eventFilter(watched, event);
  }

 private:
  std::function<void()> m_say;
};

}  // namespace

void onLanguage(QWidget* widget, std::function<void()> say) {
  say();
  new LanguageWatch(widget, std::move(say));
}

}  // namespace zerodrift::ui
