#pragma once
// The legend of every plot: swatch, tag, value, state. 22 px a row, so that 24 channels show at once.
// Hover and selection travel to the plot, which highlights the curve; a click on the swatch hides it.

#include <QColor>
#include <QString>
#include <QVector>
#include <QWidget>

#include "ui/widgets/colors.h"

class QLabel;
class QTableView;

namespace zerodrift::ui {

struct ChannelRow {
  QString id{};
  QString tag{};    // what the user calls it
  QString value{};  // with unit
  QString state{};  // "OK", "High", "No signal"; empty: no state
  Judgement judgement = Judgement::none;
  QColor color{};       // invalid: no swatch
  bool visible = true;  // whether its curve is shown
  QString tip{};
};

class ChannelModel;

class ChannelTable : public QWidget {
  Q_OBJECT

 public:
  explicit ChannelTable(QWidget* parent = nullptr);
  void setHeaders(const QString& tag, const QString& value, const QString& state);
  void setColumnWidths(int value, int state);
  /// Keeps selection and scroll position when the ids are the same as before.
  void setRows(const QVector<ChannelRow>& rows);
  const QVector<ChannelRow>& rows() const;
  /// One value, cheap enough for live data.
  void setValue(const QString& id, const QString& value, const QString& state, Judgement judgement);
  QString selectedId() const;
  void select(const QString& id);

 Q_SIGNALS:
  void hovered(const QString& id);   // empty: the pointer left
  void selected(const QString& id);  // empty: nothing selected
  void visibilityChanged(const QString& id, bool visible);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QTableView* m_view;
  ChannelModel* m_model;
  QString m_hovered;
};

}  // namespace zerodrift::ui
