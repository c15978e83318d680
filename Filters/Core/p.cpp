int hopPlaceholder() { return 0; }
