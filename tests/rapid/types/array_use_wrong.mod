! RAPID Kernel, Array elements: as many indices as dimensions, and num.
MODULE array_use_wrong
  VAR num n;
  VAR num list{3};
  VAR num table{2,2};

  PROC main()
    n:=table{1};                  ! error: T314
    n:=list{1,2};                 ! error: T314
    n:=n{1};                      ! error: T314
    n:=list{TRUE};                ! error: T301
    list:=table;                  ! error: T301
    n:=list;                      ! error: T301
    list[1]:=2;                   ! error: E120
  ENDPROC
ENDMODULE
