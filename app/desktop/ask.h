#pragma once
// A question before something that cannot be taken back: what happens in words, the deed on the button.

#include <QString>

class QWidget;

namespace zerodrift::desktop {

/// True when the person pressed `deed`; Cancel is the default and what Escape means.
bool ask(QWidget* parent, const QString& heading, const QString& text, const QString& deed);

/// The same, with what only some read in a fold; "": without one.
bool askWithDetails(QWidget* parent, const QString& heading, const QString& text, const QString& deed,
                    const QString& details);

enum class Answer {
  no,
  yes,
  other,
};

/// With a second deed beside the first.
Answer ask(QWidget* parent, const QString& heading, const QString& text, const QString& deed, const QString& other);

}  // namespace zerodrift::desktop
