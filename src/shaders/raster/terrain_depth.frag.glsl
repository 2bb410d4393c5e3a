// The ground in a shadow map: its depth alone.

void main() {}
