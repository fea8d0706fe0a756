#include "ui/widgets/company_dialog.h"

#include <QDialogButtonBox>
#include <QFileDialog>
#include <QFormLayout>
#include <QImageReader>
#include <QPlainTextEdit>

#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {
namespace {

constexpr QSize logo_most{800, 240};  // four times what it is on the paper
constexpr QSize shown_most{300, 72};

}  // namespace

CompanyDialog::CompanyDialog(const Company& company, QWidget* parent) : QDialog(parent), m_logo(company.logo) {
  setWindowTitle(tr("Your company in the report"));
  auto* what = new WrapLabel(this);
  what->setText(tr("Logo and address stand at the head of every report from this computer."));
  m_address = new QPlainTextEdit(company.address, this);
  m_address->setObjectName("companyAddress");
  m_address->setMinimumSize(360, 110);
  m_picture = new QLabel(this);
  m_problem = new WrapLabel(this);
  m_problem->setProperty("role", "bad");
  m_problem->hide();
  auto* choose = new QPushButton(tr("Choose a picture"), this);
  m_remove = new QPushButton(tr("Remove"), this);
  connect(choose, &QPushButton::clicked, this, &CompanyDialog::chooseLogo);
  connect(m_remove, &QPushButton::clicked, this, [this] {
    m_logo = {};
    showLogo();
  });
  auto* logo = new QHBoxLayout;
  logo->addWidget(m_picture, 1);
  logo->addWidget(choose);
  logo->addWidget(m_remove);
  auto* form = new QFormLayout;
  form->addRow(tr("Name and address"), m_address);
  form->addRow(tr("Logo"), logo);
  auto* buttons = new QDialogButtonBox(this);
  auto* keep = buttons->addButton(tr("Use"), QDialogButtonBox::AcceptRole);
  keep->setProperty("primary", true);
  buttons->addButton(tr("Cancel"), QDialogButtonBox::RejectRole);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  auto* all = new QVBoxLayout(this);
  all->addWidget(what);
  all->addLayout(form);
  all->addWidget(m_problem);
  all->addWidget(buttons);
  showLogo();
}

Company CompanyDialog::company() const {
  return {m_address->toPlainText().trimmed(), m_logo};
}

bool CompanyDialog::takeLogo(const QString& path) {
  QImageReader reader(path);
  reader.setAutoTransform(true);
  const QImage read = reader.read();
  m_problem->setVisible(read.isNull());
  m_problem->setText(tr("%1 is no picture that can be read: choose a PNG, JPEG or SVG file.").arg(path));
  if (read.isNull()) return false;
  const bool large = read.width() > logo_most.width() || read.height() > logo_most.height();
  m_logo = large ? read.scaled(logo_most, Qt::KeepAspectRatio, Qt::SmoothTransformation) : read;
  showLogo();
  return true;
}

void CompanyDialog::chooseLogo() {
  const QString path = QFileDialog::getOpenFileName(this, tr("Logo"), {}, tr("Pictures (*.png *.jpg *.jpeg *.svg)"));
  if (!path.isEmpty()) takeLogo(path);
}

void CompanyDialog::showLogo() {
  m_remove->setEnabled(!m_logo.isNull());
  if (m_logo.isNull()) return m_picture->setText(tr("none"));
  m_picture->setPixmap(QPixmap::fromImage(m_logo.scaled(shown_most, Qt::KeepAspectRatio, Qt::SmoothTransformation)));
}

}  // namespace zerodrift::ui
