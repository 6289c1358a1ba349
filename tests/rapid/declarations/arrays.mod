! RAPID Kernel, Array declarations: up to three dimensions, counted from 1.
MODULE arrays
  CONST num ROWS:=2;
  VAR num list{3}:=[10,20,30];
  VAR num table{ROWS,ROWS+1}:=[[1,2,3],[4,5,6]];
  VAR num cube{2,2,2}:=[[[1,2],[3,4]],[[5,6],[7,8]]];
  VAR string names{2}:=["left","right"];
  VAR pos corners{2}:=[[1,2,3],
                       [4,5,6]];
  VAR num n{2,3};

  PROC main()
    TPWrite ValToStr(list{3});        ! -> 30
    TPWrite ValToStr(table{2,1});     ! -> 4
    TPWrite ValToStr(cube{2,1,2});    ! -> 6
    TPWrite names{ROWS};              ! -> right
    TPWrite ValToStr(corners{2}.y);   ! -> 5
    n{2,3}:=9;
    TPWrite ValToStr(n);              ! -> [[0,0,0],[0,0,9]]
  ENDPROC
ENDMODULE
