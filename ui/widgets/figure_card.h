#pragma once
// A figure that decides "good enough": label, value, unit, limit, and its state in a word with a shape.

#include <QFrame>
#include <QString>
#include <QVector>

#include "ui/widgets/colors.h"

class QHBoxLayout;

namespace zerodrift::ui {

struct Figure {
  QString label{};
  QString value{};  // as many digits as the uncertainty deserves; empty shows a dash
  QString unit{};
  QString limit{};  // "limit 0.5 K", "of 20"
  Judgement judgement = Judgement::none;
  QString word{};  // "good", "too warm", "not yet"
  QString tip{};   // the reason, on hover

  bool operator==(const Figure& other) const = default;
};

/// A figure against its largest allowed value: good up to the limit, near it up to 1.25 times, else outside.
/// A value that is NaN is shown as a dash.
Figure figureAtMost(const QString& label, double value, int decimals, const QString& unit, double limit);
/// The same against a smallest allowed value.
Figure figureAtLeast(const QString& label, double value, int decimals, const QString& unit, double limit);
/// A figure without a limit.
Figure figureOf(const QString& label, double value, int decimals, const QString& unit, const QString& note = {});

class FigureCard : public QFrame {
  Q_OBJECT

 public:
  explicit FigureCard(QWidget* parent = nullptr);
  void setFigure(const Figure& figure);
  const Figure& figure() const { return m_figure; }
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  Figure m_figure;
};

/// Figures side by side, equally wide; cards are kept, so a changing value does not flicker.
class FigureRow : public QWidget {
  Q_OBJECT

 public:
  explicit FigureRow(QWidget* parent = nullptr);
  void setFigures(const QVector<Figure>& figures);
  FigureCard* card(int index) const { return m_cards.value(index); }

 private:
  QHBoxLayout* m_layout;
  QVector<FigureCard*> m_cards;
};

}  // namespace zerodrift::ui
