"""Makes clustering.json: independent values for k-means, silhouettes, dendrogram, principal components, correlations,
variance inflation and ridge by scikit-learn and scipy (Debian 12: python3-sklearn 1.2.1, python3-scipy 1.10.1).
Run: python3 make_clustering.py > clustering.json"""
import json

import numpy as np
from scipy.cluster.hierarchy import linkage
from sklearn.cluster import KMeans
from sklearn.decomposition import PCA
from sklearn.linear_model import LinearRegression, Ridge
from sklearn.metrics import adjusted_rand_score, silhouette_samples
from sklearn.metrics.pairwise import euclidean_distances

rng = np.random.default_rng(20)
hours = np.linspace(0, 4, 12)
series = []
for tau, rise in ((0.3, 12), (0.8, 8), (1.6, 5), (3.0, 3)):
    for share in (1.0, 0.9, 0.8):
        series.append(20 + share * rise * (1 - np.exp(-hours / tau)) + 0.2 * rng.standard_normal(12))
items = np.round(np.array(series), 4)
start = [0, 3, 6, 9]
fit = KMeans(n_clusters=4, init=items[start], n_init=1, algorithm="lloyd", tol=0, max_iter=1000).fit(items)
square = euclidean_distances(items, items[:1], squared=True).ravel()  # k-means++ draws the second centre by these
best = KMeans(n_clusters=5, init="k-means++", n_init=400, tol=0, max_iter=1000, random_state=1).fit(items)
links = linkage(items, "average")
pca = PCA().fit(items)
error = np.round(2.0 * items[0] - 1.5 * items[5] + 0.1 * rng.standard_normal(12), 4)
columns = items[[0, 4, 8]].T
vif = []
for j in range(3):
    others = np.delete(columns, j, axis=1)
    vif.append(1 / (1 - LinearRegression().fit(others, columns[:, j]).score(others, columns[:, j])))
standard = (columns - columns.mean(0)) / columns.std(0)
ridge = Ridge(alpha=0.7).fit(standard, error)
other = [0, 0, 0, 1, 1, 1, 1, 2, 2, 3, 3, 3]
print(json.dumps({
    "made_by": "make_clustering.py, scikit-learn 1.2.1, scipy 1.10.1, numpy 1.24.2",
    "items": items.tolist(), "initial_items": start,
    "labels": fit.labels_.tolist(), "inertia": fit.inertia_,
    "second_centre_probability": (square / square.sum()).tolist(),
    "best_of_five": best.labels_.tolist(), "best_of_five_inertia": best.inertia_,
    "silhouettes": silhouette_samples(items, fit.labels_).tolist(),
    "merges": [[int(min(a, b)), int(max(a, b)), h, int(n)] for a, b, h, n in links],
    "explained": pca.explained_variance_ratio_[:3].tolist(),
    "pc1_absolute": np.abs(pca.transform(items)[:, 0]).tolist(),
    "other_labels": other, "adjusted_rand": adjusted_rand_score(fit.labels_, other),
    "error": error.tolist(), "pearson": [float(np.corrcoef(i, error)[0, 1]) for i in items],
    "vif_items": [0, 4, 8], "vif": vif,
    "ridge_alpha": 0.7, "ridge_standardised": ridge.coef_.tolist(), "ridge_intercept": ridge.intercept_,
}, indent=1))
