! RAPID Kernel, Array declarations: sizes are whole constants above 0; values fill them exactly.
MODULE arrays_wrong
  VAR num size:=3;
  VAR num none{0};                ! error: T317
  VAR num half{2.5};              ! error: T317
  VAR num many{1,2,3,4};          ! error: T317
  VAR num varying{size};          ! error: T317
  VAR num short{3}:=[1,2];        ! error: T305
  VAR num flat{2,2}:=[1,2,3,4];   ! error: T305
ENDMODULE
