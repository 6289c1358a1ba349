! RAPID Kernel, Routine data: first in the routine; VAR or CONST, never LOCAL, TASK or PERS.
MODULE routine_data_wrong
  PROC main()
    VAR num early;
    PERS num kept:=0;             ! error: N213
    LOCAL VAR num hidden;         ! error: N213
    TASK VAR num of_task;         ! error: N213
    early:=kept+hidden+of_task;
    VAR num late;                 ! error: E104
    IF early=0 THEN
      VAR num inner;              ! error: E104
      inner:=late;
    ENDIF
  ENDPROC
ENDMODULE
