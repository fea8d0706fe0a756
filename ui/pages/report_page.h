#pragma once
// The report (J2): preview at the right, sections and head at the left, figures that look doubtful first.

#include <QImage>
#include <QStringList>

#include "ui/pages/page.h"
#include "ui/widgets/colors.h"

class QComboBox;
class QFormLayout;
class QLabel;
class QLineEdit;
class QListWidget;
class QPushButton;
class QScrollArea;
class QStackedWidget;

namespace zerodrift::ui {

class Card;
class PaperSheet;
class SignaturePad;
class ToggleSegment;

struct ReportSection {
  QString id{};
  QString title{};
  bool included = true;
  QString note{};  // why it is empty or cannot be left out
  bool always = false;
};

/// A figure that a reader would ask about, and the page where it can be looked into.
struct DoubtfulFigure {
  QString text{};
  Judgement judgement = Judgement::warn;
  QString pageId{};
  QString group{};  // what it is about, in words: the step
};

struct ReportHead {
  QString customer{};
  QString machine{};
  QString serial{};
  QString engineer{};
  QString standards{};  // "ISO 230-3:2020, ISO 230-2:2014"

  bool operator==(const ReportHead& other) const = default;
};

struct ReportState {
  QString blocked{};
  ReportHead head{};
  QStringList languages{};
  int language = 0;
  QVector<ReportSection> sections{};
  QVector<DoubtfulFigure> doubtful{};
  QVector<QImage> pages{};  // preview
  QString savedTo{};        // path of the last saved report
};

class ReportPage : public Page {
  Q_OBJECT

 public:
  explicit ReportPage(QWidget* parent = nullptr);
  void setState(const ReportState& state);
  const ReportState& state() const { return m_state; }

  QString title() const override;
  QString sentence() const override;
  PageAction primary() const override;
  /// "print", "bundle"; "open" and "folder" of what was saved.
  QVector<PageAction> secondary() const override;

  /// It was given for another report.
  void clearSignature();

 Q_SIGNALS:
  void headEdited(const zerodrift::ui::ReportHead& head);
  void languageChosen(int index);
  void companyRequested();
  void sectionToggled(const QString& sectionId, bool included);
  void doubtClicked(const QString& pageId);
  void signatureDrawn(const QImage& signature);  // null: cleared

 protected:
  void render() override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  Card* makeHeadCard();
  Card* makeSectionCard();
  void renderHead();
  void renderSections();
  void renderDoubtful();
  void renderPreview();

  ReportState m_state;
  Card* m_headCard;
  Card* m_sectionCard;
  Card* m_previewCard;
  QVector<QLabel*> m_fieldNames;
  QVector<QLineEdit*> m_fields;
  QLabel* m_languageName;
  QComboBox* m_language;
  QPushButton* m_company;
  QListWidget* m_sections;
  QListWidget* m_doubtful;
  ToggleSegment* m_view;
  QStackedWidget* m_views;
  QScrollArea* m_scroll;
  QLabel* m_noPreview;
  QVector<PaperSheet*> m_sheets;
  SignaturePad* m_signature;
  bool m_filling = false;
};

}  // namespace zerodrift::ui
