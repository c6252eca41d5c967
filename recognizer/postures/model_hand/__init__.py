"""A jointed model hand and its silhouettes: postures learnt from nobody's photo."""
