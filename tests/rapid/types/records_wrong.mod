! RAPID Kernel, Record types: every component, in order, of its type.
MODULE records_wrong
  RECORD part
    num number;
    string name;
    num number;                   ! error: N202
  ENDRECORD
  RECORD box
    num sides{4};                 ! error: E147
  ENDRECORD
  RECORD loop                     ! error: T322
    loop next;
  ENDRECORD
  VAR pos short:=[1,2];           ! error: T305
  VAR pos long:=[1,2,3,4];        ! error: T305
  VAR pos mixed:=[1,"2",3];       ! error: T301
  VAR pos p;

  PROC main()
    p.w:=1;                       ! error: N212
    p:=[1,2];                     ! error: T305
  ENDPROC
ENDMODULE
