#pragma once
// A level with the range that is good: focus, exposure. Word and shape say how it stands.

#include <QString>
#include <QWidget>

#include "ui/widgets/colors.h"

namespace zerodrift::ui {

class LevelBar : public QWidget {
  Q_OBJECT

 public:
  explicit LevelBar(QWidget* parent = nullptr);
  /// level and the good range 0..1; NaN: unknown.
  void setLevel(const QString& label, double level, double goodFrom, double goodTo, const QString& word,
                Judgement judgement);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QString m_label;
  QString m_word;
  double m_level = 0.0;
  double m_goodFrom = 0.0;
  double m_goodTo = 1.0;
  Judgement m_judgement = Judgement::none;
};

}  // namespace zerodrift::ui
